// Actors: their games are legal, their targets are sound and their signs right, in every game.
#include "selfplay/training/actor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "engine/games.h"
#include "search/network_evaluator.h"
#include "tests/search/fake_network.h"

namespace selfplay::training {
namespace {

// Answers that a test makes up.
template <engine::Encoded G>
class Oracle final : public search::EvaluatorSource<G> {
   public:
    using Answer = std::function<void(const search::Query<G>&)>;
    explicit Oracle(Answer answer) : answer_(std::move(answer)) {}

    std::unique_ptr<search::Evaluator<G>> make_evaluator() const override {
        return std::make_unique<Own>(answer_);
    }
    std::string_view name() const override { return "oracle"; }
    void check(const G&) const override {}
    int policy_index(const G&, engine::Move) const override { return 0; }

   private:
    class Own final : public search::Evaluator<G> {
       public:
        explicit Own(const Answer& answer) : answer_(answer) {}
        void evaluate(std::span<const search::Query<G>> queries) override {
            for (const auto& query : queries) {
                auto& to = *query.answer;
                to = {};
                const auto count = static_cast<std::size_t>(query.moves->size());
                to.priors.assign(count, 1 / static_cast<float>(count));
                to.win = to.loss = 0.5f;
                answer_(query);
            }
        }
        int symmetries(const G&) const override { return 1; }
        std::uint64_t key(const G& game) const override { return game.key(); }

       private:
        Answer answer_;
    };
    Answer answer_;
};

template <class G>
typename Actor<G>::Source even() {
    return std::make_shared<Oracle<G>>([](const search::Query<G>&) {});
}

template <class G>
std::vector<records::Game> games_of(const ActorSettings& settings, std::uint64_t seed,
                                    typename Actor<G>::Source network, std::uint64_t count) {
    std::vector<records::Game> games;
    Actor<G> actor(
        settings, seed, std::move(network), 7,
        [&](records::Game game) { games.push_back(std::move(game)); }, count);
    while (actor.advance()) {
    }
    return games;
}

ActorSettings small_settings() {
    ActorSettings settings;
    settings.games = 5;
    settings.batch = 3;
    settings.simulations = 8;
    settings.fast_simulations = 3;
    settings.size = 5;
    settings.move_limit = 60;
    return settings;
}

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
