// Actors: their games are legal, their targets are sound and their signs right, in every game.
#include "selfplay/training/actor.h"

#include <gtest/gtest.h>

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

TYPED_TEST(EveryGame, RecordsAreLegalAndTargetsSumToOne) {
    using G = TypeParam;
    const auto games = games_of<G>(small_settings(), 1, even<G>(), 12);
    ASSERT_EQ(games.size(), 12u);
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
                EXPECT_NEAR(sum, 65535, 40);
                EXPECT_EQ(turn.simulations, 8u);
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
    for (const auto& record : games_of<G>(settings, 1, network, 6))
        for (std::size_t i = 0; i < record.turns.size(); ++i)
            EXPECT_NEAR(record.turns[i].value, i % 2 == 0 ? 0.8f : -0.8f, 0.01f) << i;
}

}  // namespace
}  // namespace selfplay::training
