#include "search/gumbel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <thread>
#include <vector>

namespace search {
namespace {

using engine::Move;
using engine::MoveList;

constexpr std::size_t mebibyte = std::size_t{1} << 20;

// A root whose i-th move always turns out to be worth `values[i]` to the player to move there.
class Bandit {
   public:
    Bandit(std::vector<float> priors, std::vector<float> values, float own = 0)
        : values_(std::move(values)) {
        MoveList moves;
        for (std::size_t i = 0; i < priors.size(); ++i) moves.push({static_cast<std::uint16_t>(i)});
        tree.enter_root();
        EXPECT_TRUE(tree.claim(tree.root()));
        EXPECT_TRUE(tree.expand(tree.root(), moves, priors));
        tree.back_up({tree.root()}, own);
    }

    void descend(Move first) {
        tree.enter_root();
        const NodeId child = tree.enter(tree.edges_to_enter(tree.root())[first.code]);
        tree.back_up({tree.root(), child}, -values_[first.code]);
    }
    std::vector<std::uint32_t> visits() const {
        std::vector<std::uint32_t> counts;
        for (const Edge& edge : tree.edges(tree.root())) {
            const NodeId child = tree.child(tree.root(), edge);
            counts.push_back(child == no_node ? 0 : tree[child].visits.load());
        }
        return counts;
    }

    Tree tree{mebibyte};

   private:
    std::vector<float> values_;
};

GumbelParams without_noise() {
    GumbelParams params;
    params.noise = 0;
    return params;
}

const MoveFilter all;
using Counts = std::vector<std::uint32_t>;

TEST(Gumbel, HalvesTheCandidatesAndGivesEachTheSame) {
    Bandit bandit({0.4f, 0.3f, 0.2f, 0.1f}, {0, 0.1f, 0.8f, 0.9f});
    engine::Random random(1);
    GumbelRoot root(bandit.tree, all, 16, without_noise(), random);
    for (int i = 0; i < 16; ++i) bandit.descend(root.next());
    EXPECT_EQ(bandit.visits(), (Counts{2, 2, 6, 6}));
    EXPECT_EQ(root.best(), Move{3});
}

TEST(Gumbel, WithoutNoiseTheHighestPriorsTakePart) {
    Bandit bandit({0.1f, 0.2f, 0.3f, 0.4f}, {1, 1, 0, 0});
    engine::Random random(1);
    auto params = without_noise();
    params.considered = 2;
    GumbelRoot root(bandit.tree, all, 10, params, random);
    for (int i = 0; i < 10; ++i) bandit.descend(root.next());
    EXPECT_EQ(bandit.visits(), (Counts{0, 0, 5, 5}));
}

TEST(Gumbel, NoMoreTakePartThanThereAreSimulations) {
    Bandit bandit({0.1f, 0.2f, 0.3f, 0.4f}, {0, 0, 1, 0});
    engine::Random random(1);
    GumbelRoot root(bandit.tree, all, 2, without_noise(), random);
    for (int i = 0; i < 2; ++i) bandit.descend(root.next());
    EXPECT_EQ(bandit.visits(), (Counts{0, 0, 1, 1}));
    EXPECT_EQ(root.best(), Move{2});
}

TEST(Gumbel, BarredMovesTakeNoPart) {
    Bandit bandit({0.4f, 0.3f, 0.2f, 0.1f}, {1, 1, 0, 0});
    MoveFilter some;
    const Move barred[] = {{0}, {1}};
    some.restrict({}, barred);
    engine::Random random(1);
    GumbelRoot root(bandit.tree, some, 20, {}, random);
    for (int i = 0; i < 20; ++i) bandit.descend(root.next());
    EXPECT_EQ(bandit.visits(), (Counts{0, 0, 10, 10}));
    const auto policy = improved_policy(bandit.tree, some, {});
    EXPECT_EQ(policy[0] + policy[1], 0);
}

TEST(Gumbel, ALoneMoveIsSearched) {
    Bandit bandit({1}, {0.5f});
    engine::Random random(1);
    GumbelRoot root(bandit.tree, all, 5, {}, random);
    for (int i = 0; i < 7; ++i) bandit.descend(root.next());
    EXPECT_EQ(bandit.visits(), Counts{7});
    EXPECT_EQ(root.best(), Move{0});
}

TEST(Gumbel, WithoutANumberRoundsDoubleAndAllComeBack) {
    Bandit bandit({0.25f, 0.25f, 0.25f, 0.25f}, {0, 0.01f, 0.5f, 0.6f});
    engine::Random random(1);
    GumbelRoot root(bandit.tree, all, std::nullopt, without_noise(), random);
    for (int i = 0; i < 64; ++i) bandit.descend(root.next());
    EXPECT_EQ(bandit.visits(), (Counts{8, 8, 24, 24}));
    for (int i = 0; i < 64; ++i) bandit.descend(root.next());
    EXPECT_EQ(bandit.visits(), (Counts{24, 24, 40, 40}));
    for (int i = 0; i < 10000; ++i) bandit.descend(root.next());
    EXPECT_EQ(root.best(), Move{3});
}

// The Gumbel-max trick: with one simulation the move is drawn from the priors.
TEST(Gumbel, OneSimulationDrawsFromThePriors) {
    const std::vector<float> priors = {0.5f, 0.3f, 0.15f, 0.05f};
    std::vector<int> drawn(4);
    engine::Random random(1);
    for (int i = 0; i < 4000; ++i) {
        Bandit bandit(priors, {0, 0, 0, 0});
        GumbelRoot root(bandit.tree, all, 1, {}, random);
        bandit.descend(root.next());
        ++drawn[root.best().code];
    }
    for (std::size_t i = 0; i < priors.size(); ++i)
        EXPECT_NEAR(drawn[i] / 4000.0, static_cast<double>(priors[i]), 0.03);
}

// The paper's claim, in the mean over draws: better than the policy it started from.
TEST(Gumbel, TwoSimulationsImproveThePolicy) {
    const std::vector<float> priors = {0.4f, 0.3f, 0.2f, 0.1f}, values = {-0.2f, 0.1f, 0.0f, 0.5f};
    const float prior_value =
        std::inner_product(priors.begin(), priors.end(), values.begin(), 0.0f);
    engine::Random random(1);
    float sum = 0;
    for (int i = 0; i < 2000; ++i) {
        Bandit bandit(priors, values, prior_value);
        GumbelRoot root(bandit.tree, all, 2, {}, random);
        for (int j = 0; j < 2; ++j) bandit.descend(root.next());
        sum += values[root.best().code];
    }
    EXPECT_GT(sum / 2000, prior_value + 0.05f);
}

TEST(Gumbel, ThePolicyOfAnUnsearchedRootIsThePriors) {
    const std::vector<float> priors = {0.5f, 0.3f, 0.2f};
    const Bandit bandit(priors, {0, 0, 0}, 0.7f);
    const auto policy = improved_policy(bandit.tree, all, {});
    for (std::size_t i = 0; i < priors.size(); ++i) EXPECT_NEAR(policy[i], priors[i], 1e-3);
}

// By hand: the root is worth 0.2 by itself, its visited move 0.6, so an unvisited one is worth
// (0.2 + 1 * 0.6) / 2 = 0.4; turned to [0, 1] the two are 0.1 apart.
TEST(Gumbel, UnvisitedMovesAreWorthTheMixedValue) {
    Bandit bandit({0.5f, 0.5f}, {0.6f, 0}, 0.2f);
    bandit.descend({0});
    auto params = without_noise();
    params.visit_offset = 9;
    const auto policy = improved_policy(bandit.tree, all, params);
    EXPECT_NEAR(policy[0] + policy[1], 1, 1e-5);
    EXPECT_NEAR(std::log(policy[0] / policy[1]), (9 + 1) * 0.1, 1e-3);
}

TEST(Gumbel, GoesOnAfterAFlip) {
    Bandit bandit({0.4f, 0.3f, 0.2f, 0.1f}, {0, 0.1f, 0.8f, 0.9f});
    engine::Random random(1);
    GumbelRoot root(bandit.tree, all, 64, without_noise(), random);
    for (int i = 0; i < 64; ++i) {
        bandit.descend(root.next());
        if (i == 40) bandit.tree.flip();
    }
    EXPECT_EQ(bandit.visits(), (Counts{8, 8, 24, 24}));
    EXPECT_EQ(root.best(), Move{3});
}

TEST(Gumbel, ManyThreadsShareOnePlan) {
    Bandit bandit(std::vector<float>(16, 1 / 16.0f), std::vector<float>(16, 0.0f));
    engine::Random random(1);
    GumbelRoot root(bandit.tree, all, 6400, {}, random);
    std::vector<std::vector<int>> counts(4, std::vector<int>(16));
    std::vector<std::thread> threads;
    threads.reserve(counts.size());
    for (auto& count : counts)
        threads.emplace_back([&] {
            for (int i = 0; i < 1600; ++i) ++count[root.next().code];
        });
    for (auto& thread : threads) thread.join();
    int given = 0, least = 6400;
    for (std::size_t i = 0; i < 16; ++i) {
        int sum = 0;
        for (const auto& count : counts) sum += count[i];
        given += sum;
        least = std::min(least, sum);
    }
    EXPECT_EQ(given, 6400);
    // All of the first phase, which is known from the start. When a later one begins hangs on the
    // thread that ranks its candidates: nobody waits for that.
    EXPECT_GE(least, 100);
}

}  // namespace
}  // namespace search
