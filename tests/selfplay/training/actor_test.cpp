// Actors: their games are legal, their targets are sound and their signs right, in every game.
#include "selfplay/training/actor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "engine/base/error.h"
#include "engine/games.h"
#include "search/network_evaluator.h"
#include "tests/search/fake_network.h"
#include "tests/selfplay/training/play.h"

namespace selfplay::training {
namespace {

template <class G>
class EveryGame : public testing::Test {};
using AllGames = testing::Types<go::Go, chess::Chess, shogi::Shogi>;
TYPED_TEST_SUITE(EveryGame, AllGames);

template <class G>
void check_games(const ActorSettings& settings) {
    const auto games = games_of<G>(settings, 1, even<G>(), 12);
    ASSERT_EQ(games.size(), 12u);
    int taught = 0;
    for (const auto& record : games) {
        EXPECT_EQ(record.game, G::name);
        EXPECT_EQ(record.steps, 7u);
        EXPECT_NE(record.outcome, engine::Outcome::ongoing);
        G game = G::from_text(record.start);
        for (const auto& turn : record.turns) {
            const auto legal = game.legal_moves();
            ASSERT_EQ(game.outcome(), engine::Outcome::ongoing);
            int sum = 0;
            for (const auto& share : record.policy(turn)) {
                EXPECT_TRUE(legal.contains(share.move));
                sum += share.share;
            }
            if (turn.share_count > 0) {
                EXPECT_NEAR(sum, 65535, legal.size());
                EXPECT_EQ(turn.simulations, 8u);
                ++taught;
            }
            ASSERT_TRUE(legal.contains(turn.move));
            game.play(turn.move);
        }
        if (record.ending == records::Ending::rules) {
            EXPECT_EQ(game.outcome(), record.outcome);
        } else {
            EXPECT_EQ(record.turns.size(), 60u);
        }
    }
    EXPECT_GT(taught, 40);
}

TYPED_TEST(EveryGame, RecordsAreLegalAndTargetsSumToOne) {
    for (const auto exploration : {Exploration::gumbel, Exploration::noise}) {
        auto settings = small_settings();
        settings.exploration = exploration;
        check_games<TypeParam>(settings);
    }
}

// Of a network that calls everything even, what searches expected in all.
template <class G>
float expected_in_all(float lambda) {
    auto settings = small_settings();
    settings.move_limit = 40;
    settings.lambda = lambda;
    float sum = 0;
    for (const auto& record : games_of<G>(settings, 1, even<G>(), 6))
        for (const auto& turn : record.turns) sum += std::abs(turn.value);
    return sum;
}

TYPED_TEST(EveryGame, WithLambdaPositionsArePlayedOutBesides) {
    EXPECT_GT(expected_in_all<TypeParam>(0.5f), 4 + 2 * expected_in_all<TypeParam>(0));
}

// Their answers differ from move to move, and are as random as the seed.
TYPED_TEST(EveryGame, RolloutsTakeANetworksPlace) {
    auto settings = small_settings();
    settings.move_limit = 20;
    const auto games = games_of<TypeParam>(settings, 1, nullptr, 6);
    ASSERT_EQ(games.size(), 6u);
    EXPECT_EQ(games_of<TypeParam>(settings, 1, nullptr, 6), games);
    bool unlike = false;
    for (const auto& record : games) {
        EXPECT_TRUE(record.by_rollouts);
        TypeParam game = TypeParam::from_text(record.start);
        for (const auto& turn : record.turns) {
            ASSERT_TRUE(game.legal_moves().contains(turn.move));
            game.play(turn.move);
            EXPECT_LE(std::abs(turn.value) + turn.draws, 1.001f);
            unlike = unlike || turn.value != 0;
        }
    }
    EXPECT_TRUE(unlike);
    for (const auto& record : games_of<TypeParam>(settings, 1, even<TypeParam>(), 2))
        EXPECT_FALSE(record.by_rollouts);
}

TYPED_TEST(EveryGame, EqualSeedsGiveEqualGames) {
    using G = TypeParam;
    const auto network = std::make_shared<search::NetworkSource<G>>(
        std::make_shared<search::Network>(fake::small_network<G>(), nn::Precision::fp32));
    auto settings = small_settings();
    settings.move_limit = 12;
    const auto games = games_of<G>(settings, 1, network, 6);
    EXPECT_EQ(games, games_of<G>(settings, 1, network, 6));
    EXPECT_NE(games, games_of<G>(settings, 2, network, 6));
}

// A network that always takes the first player to be winning: every value must say so.
TYPED_TEST(EveryGame, ValuesAreTheMovers) {
    using G = TypeParam;
    const auto network = std::make_shared<Oracle<G>>([](const search::Query<G>& query) {
        const bool first = query.game->to_play() == engine::Player::first;
        query.answer->win = first ? 0.9f : 0.1f;
        query.answer->loss = 1 - query.answer->win;
    });
    auto settings = small_settings();
    settings.move_limit = 10;
    settings.resign = -1;
    settings.komi = -100.5f;
    for (const auto& record : games_of<G>(settings, 1, network, 6))
        for (std::size_t i = 0; i < record.turns.size(); ++i)
            EXPECT_GT(record.turns[i].value * (i % 2 == 0 ? 1 : -1), 0.79f) << i;
}

// The share of turns with a full search is the one asked for.
TEST(Actor, FastSearchesTeachNoPolicy) {
    auto settings = small_settings();
    settings.size = 7;
    settings.full_share = 0.25f;
    settings.opening_share = 0;
    int turns = 0, taught = 0;
    for (const auto& game : games_of<go::Go>(settings, 1, even<go::Go>(), 40))
        for (const auto& turn : game.turns) {
            ++turns;
            taught += turn.share_count > 0;
            if (turn.simulations != 0) {
                EXPECT_EQ(turn.simulations, turn.share_count > 0 ? 8u : 3u);
            }
        }
    EXPECT_GT(turns, 1000);
    EXPECT_NEAR(static_cast<double>(taught) / turns, 0.25, 0.03);
}

TEST(Actor, OpeningsAreDrawnFromThePolicy) {
    auto settings = small_settings();
    settings.opening_share = 1;
    settings.opening_moves = 4;
    const auto first_point =
        std::make_shared<Oracle<go::Go>>([](const search::Query<go::Go>& query) {
            auto& priors = query.answer->priors;
            // The first point of the board, and never a pass.
            std::fill(priors.begin(), priors.end(), 0.0f);
            priors.front() = 1;
        });
    double drawn = 0;
    const auto games = games_of<go::Go>(settings, 1, first_point, 60);
    for (const auto& record : games) {
        auto game = go::Go::from_text(record.start);
        for (const auto& turn : record.turns) {
            if (turn.simulations != 0) break;
            EXPECT_EQ(turn.move, game.legal_moves()[0]);
            game.play(turn.move);
            ++drawn;
        }
    }
    EXPECT_NEAR(drawn / 60, 4, 1);
}

TEST(Actor, PlaysOnBoardsOfSeveralSizes) {
    auto settings = small_settings();
    settings.size = 7;
    settings.least_size = 5;
    settings.small_share = 0.5f;
    settings.komi_deviation = 2;
    std::map<int, int> sizes, komis;
    for (const auto& record : games_of<go::Go>(settings, 1, even<go::Go>(), 100)) {
        const auto start = go::Go::from_text(record.start);
        ++sizes[start.size()];
        ++komis[start.komi().halves()];
        EXPECT_EQ(record.owners.size(), static_cast<std::size_t>(start.size() * start.size()));
    }
    EXPECT_EQ(sizes.size(), 3u);
    EXPECT_NEAR(sizes[7], 50, 20);
    EXPECT_GT(komis.size(), 4u);
    for (const auto& [halves, games] : komis) EXPECT_EQ(halves % 2, 1) << games;
}

// Owners and lead are the first player's, whoever was to move.
TEST(Actor, RecordsTheScore) {
    auto settings = small_settings();
    settings.komi = 0.5f;
    for (const auto& record : games_of<go::Go>(settings, 3, even<go::Go>(), 20)) {
        int sum = 0;
        for (const int owner : record.owners) sum += owner;
        EXPECT_FLOAT_EQ(record.lead, static_cast<float>(sum) - 0.5f);
        EXPECT_EQ(record.outcome,
                  record.lead > 0 ? engine::Outcome::first_wins : engine::Outcome::second_wins);
    }
}

// Believes that the second player is lost, as it is: komi is against it.
TEST(Actor, ResignsOnceGamesPlayedOnAllowIt) {
    auto settings = small_settings();
    settings.komi = -100.5f;
    settings.play_on_share = 0.25f;
    settings.opening_share = 0;
    const auto network = std::make_shared<Oracle<go::Go>>([](const search::Query<go::Go>& query) {
        const bool first = query.game->to_play() == engine::Player::first;
        query.answer->win = first ? 0.99f : 0.01f;
        query.answer->loss = 1 - query.answer->win;
    });
    std::vector<records::Game> games = games_of<go::Go>(settings, 1, network, 200);
    int resigned = 0;
    for (std::size_t i = 0; i < games.size(); ++i) {
        if (games[i].ending != records::Ending::resigned) continue;
        if (i < 40) ADD_FAILURE() << "game " << i << " was given up before anything was known";
        ++resigned;
        EXPECT_EQ(games[i].outcome, engine::Outcome::first_wins);
        EXPECT_EQ(games[i].turns.size(), 5u);
        EXPECT_TRUE(games[i].owners.empty());
    }
    EXPECT_GT(resigned, 60);
    EXPECT_LT(resigned, 160);
}

// As before, but komi is for the second player: no threshold is safe.
TEST(Actor, NeverResignsWhenValuesAreWrong) {
    auto settings = small_settings();
    settings.komi = 100.5f;
    const auto network = std::make_shared<Oracle<go::Go>>([](const search::Query<go::Go>& query) {
        const bool first = query.game->to_play() == engine::Player::first;
        query.answer->win = first ? 0.99f : 0.01f;
        query.answer->loss = 1 - query.answer->win;
    });
    for (const auto& game : games_of<go::Go>(settings, 1, network, 100))
        EXPECT_NE(game.ending, records::Ending::resigned);
}

records::Game game_with(std::vector<float> values, engine::Outcome outcome) {
    records::Game game;
    for (const float value : values) game.add({1}, value, 10, {}, {});
    game.outcome = outcome;
    return game;
}

TEST(ResignWatch, KnowsHowLongAValueWasLow) {
    const auto game = game_with({0.5f, -0.2f, 0.1f, -0.95f, 0.2f, -0.9f, 0.9f, 0.1f},
                                engine::Outcome::first_wins);
    EXPECT_FLOAT_EQ(lowest_held(game, engine::Player::second, 1), -0.95f);
    EXPECT_FLOAT_EQ(lowest_held(game, engine::Player::second, 2), -0.9f);
    EXPECT_FLOAT_EQ(lowest_held(game, engine::Player::second, 3), -0.2f);
    EXPECT_FLOAT_EQ(lowest_held(game, engine::Player::first, 2), 0.2f);
    EXPECT_FLOAT_EQ(lowest_held(game, engine::Player::first, 9), 1);
}

TEST(ResignWatch, LowersTheThresholdUntilErrorsAreRare) {
    ResignWatch watch(-0.8f, 1, 0.05f);
    const auto lost = game_with({-0.99f, 0.5f}, engine::Outcome::second_wins);
    const auto saved = game_with({-0.85f, 0.5f}, engine::Outcome::first_wins);
    for (int i = 0; i < 90; ++i) watch.add(lost);
    EXPECT_FLOAT_EQ(watch.threshold(), -0.8f);
    EXPECT_EQ(watch.given_up(), 90u);
    for (int i = 0; i < 10; ++i) watch.add(saved);
    EXPECT_LE(watch.threshold(), -0.85f);
    EXPECT_GT(watch.threshold(), -0.99f);
    EXPECT_EQ(watch.error_rate(), 0);
}

TEST(Actor, ANewNetworkTakesOverBetweenAnswers) {
    const auto says = [](float win) {
        return std::make_shared<Oracle<go::Go>>([win](const search::Query<go::Go>& query) {
            const bool first = query.game->to_play() == engine::Player::first;
            query.answer->win = first ? win : 1 - win;
            query.answer->loss = 1 - query.answer->win;
        });
    };
    auto settings = small_settings();
    settings.resign = -1;
    settings.komi = 0.5f;
    std::uint64_t steps = 100;
    int late = 0;
    Actor<go::Go> actor(
        settings, 1, says(0.9f), steps,
        [&](const records::Game& game) {
            EXPECT_EQ(game.steps, steps);
            EXPECT_GT(game.turns[0].value, 0.5f);
            if (steps == 200 && game.turns.size() > 12) {
                const auto last = game.turns.size() - 1;
                EXPECT_LT(game.turns[last].value * (last % 2 == 0 ? 1 : -1), 0);
                ++late;
            }
        },
        5);
    for (int i = 0; i < 10; ++i) ASSERT_TRUE(actor.advance());
    actor.set_network(says(0.1f), steps = 200);
    while (actor.advance()) {
    }
    EXPECT_GT(late, 0);
    EXPECT_EQ(actor.counts().games, 5u);
    EXPECT_GT(actor.counts().evaluations, 100u);
}

TEST(Actor, RefusesSettingsThatDoNotFit) {
    auto settings = small_settings();
    settings.fast_simulations = settings.simulations + 1;
    settings.full_share = 1;  // then no search is fast
    EXPECT_NO_THROW(check(settings));
    settings.full_share = 0.5;
    EXPECT_THROW(check(settings), engine::Error);
    EXPECT_THROW(games_of<go::Go>(settings, 1, even<go::Go>(), 1), engine::Error);
    settings = small_settings();
    settings.least_size = 6;
    EXPECT_THROW(games_of<go::Go>(settings, 1, even<go::Go>(), 1), engine::Error);
}

}  // namespace
}  // namespace selfplay::training
