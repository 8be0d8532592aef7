// What every game may expect of every way of searching.
#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "engine/games.h"
#include "search/network.h"
#include "search/network_evaluator.h"
#include "search/searcher.h"
#include "tests/search/fake_network.h"

using namespace std::chrono_literals;

namespace search {
namespace {

template <class G>
G start() {
    if constexpr (std::is_same_v<G, go::Go>)
        return go::Go(9);
    else
        return G();
}

template <class G>
std::shared_ptr<const EvaluatorSource<G>> small_source() {
    return std::make_shared<NetworkSource<G>>(
        std::make_shared<Network>(fake::small_network<G>(), nn::Precision::fp32));
}

// Sound at first, then no numbers any more, as a network does whose weights are damaged.
template <class G>
class Damaged final : public Evaluator<G> {
   public:
    explicit Damaged(int sound) : sound_(sound) {}
    void evaluate(std::span<const Query<G>> queries) override {
        for (const auto& query : queries) {
            query.answer->win = query.answer->loss = 0.5f;
            auto& priors = query.answer->priors;
            priors.assign(static_cast<std::size_t>(query.moves->size()), 1);
            if (sound_-- <= 0) priors[0] = std::numeric_limits<float>::quiet_NaN();
            if (!softmax(priors)) engine::fail("the network yields what is no number");
        }
    }
    int symmetries(const G&) const override { return 1; }
    std::uint64_t key(const G& game) const override { return game.key(); }

   private:
    int sound_;
};

template <class G>
class DamagedSource final : public EvaluatorSource<G> {
   public:
    explicit DamagedSource(int sound) : sound_(sound) {}
    std::unique_ptr<Evaluator<G>> make_evaluator() const override {
        return std::make_unique<Damaged<G>>(sound_);
    }
    std::string_view name() const override { return "damaged"; }
    void check(const G&) const override {}
    int policy_index(const G&, Move) const override { return 0; }

   private:
    int sound_;
};

SearchParams small(Method method) {
    SearchParams params;
    params.memory_mib = 16;
    params.method = method;
    params.early_end = false;
    params.threads = 2;
    return params;
}

Limits simulations(std::uint64_t count) {
    Limits limits;
    limits.simulations = count;
    return limits;
}

template <class G>
void expect_legal(const Analysis& picture, const G& game) {
    ASSERT_FALSE(picture.moves.empty());
    EXPECT_TRUE(game.legal_moves().contains(picture.moves[0].move));
}

template <class G>
class SearchContract : public ::testing::Test {};
using AllGames = ::testing::Types<go::Go, chess::Chess, shogi::Shogi>;
TYPED_TEST_SUITE(SearchContract, AllGames);

TYPED_TEST(SearchContract, PlaysLegalMovesByEveryMethod) {
    for (const auto method : {Method::uct, Method::puct, Method::gumbel}) {
        Searcher<TypeParam> searcher(small(method));
        searcher.set_position(start<TypeParam>());
        searcher.set_network(small_source<TypeParam>());
        for (int ply = 0; ply < 4; ++ply) {
            const auto picture = searcher.think(simulations(40));
            EXPECT_EQ(picture.simulations, 40u);
            expect_legal(picture, searcher.position());
            searcher.advance(picture.moves[0].move);
        }
    }
}

TYPED_TEST(SearchContract, PlaysLegalMovesAtEveryLevelAndTemperature) {
    auto params = small(Method::puct);
    Searcher<TypeParam> searcher(params);
    searcher.set_position(start<TypeParam>());
    searcher.set_network(small_source<TypeParam>());
    for (params.level = 0; params.level <= 8; params.level += 4) {
        searcher.set_params(params);
        const auto picture = searcher.think(simulations(60));
        EXPECT_LE(picture.simulations, simulations_of_level(params.level));
        expect_legal(picture, searcher.position());
    }
    params.level = full_level;
    params.temperature = 1;
    params.noise = 0.25f;
    params.policy_temperature = 1.5f;
    searcher.set_params(params);
    expect_legal(searcher.think(simulations(30)), searcher.position());
}

TYPED_TEST(SearchContract, ADamagedNetworkEndsTheThinkWithAMessage) {
    for (const int sound : {0, 5}) {
        Searcher<TypeParam> searcher(small(Method::puct));
        searcher.set_position(start<TypeParam>());
        searcher.set_network(std::make_shared<DamagedSource<TypeParam>>(sound));
        const auto picture = searcher.think(simulations(1000));
        EXPECT_EQ(picture.fault, "the network yields what is no number");
        if (sound > 2) expect_legal(picture, searcher.position());
        // It may be asked again.
        EXPECT_FALSE(searcher.think(simulations(10)).fault.empty());
    }
}

TYPED_TEST(SearchContract, KeepsToByoYomi) {
    auto params = small(Method::automatic);
    params.lag_ms = 500;  // a busy machine wakes the one who watches late
    Searcher<TypeParam> searcher(params);
    searcher.set_position(start<TypeParam>());
    Limits limits;
    TimeControl control;
    control.unlimited = false;
    control.period = 1s;
    control.periods = 1;
    limits.clock = TimeLeft::start_of(control);
    const auto picture = searcher.think(limits);
    EXPECT_LT(picture.elapsed, 1s);
    expect_legal(picture, searcher.position());
}

TYPED_TEST(SearchContract, OneThreadAndOneSeedGiveOneTree) {
    auto params = small(Method::gumbel);
    params.threads = 1;
    params.noise = 0.25f;
    params.gumbel_noise = 1;
    std::vector<std::uint64_t> first;
    for (int time = 0; time < 2; ++time) {
        Searcher<TypeParam> searcher(params);
        searcher.set_position(start<TypeParam>());
        searcher.set_network(small_source<TypeParam>());
        std::vector<std::uint64_t> visits;
        for (const auto& move : searcher.think(simulations(60)).moves)
            visits.push_back(move.visits << 16 | move.move.code);
        if (time == 0) first = visits;
        EXPECT_EQ(visits, first);
    }
}

}  // namespace
}  // namespace search
