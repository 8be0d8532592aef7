#include "search/tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <thread>
#include <vector>

#include "engine/base/random.h"

namespace search {
namespace {

using engine::Move;
using engine::MoveList;

constexpr std::size_t mebibyte = std::size_t{1} << 20;

MoveList moves(int count) {
    MoveList list;
    for (int i = 0; i < count; ++i) list.push({static_cast<std::uint16_t>(i)});
    return list;
}

// Expands the root with `count` moves by a descent of value 0.
void expand_root(Tree& tree, int count) {
    tree.enter_root();
    ASSERT_TRUE(tree.claim(tree.root()));
    ASSERT_TRUE(tree.expand(tree.root(), moves(count), {}));
    tree.back_up({tree.root()}, 0);
}

// A descent to the root's i-th child that ends there.
NodeId visit_child(Tree& tree, std::size_t i, float value) {
    tree.enter_root();
    const NodeId child = tree.enter(tree.edges_to_enter(tree.root())[i]);
    tree.back_up({tree.root(), child}, value);
    return child;
}

TEST(Tree, NodesAndEdgesStaySmall) {
    EXPECT_LE(sizeof(Node), 40u);
    EXPECT_LE(sizeof(Edge), 12u);
}

TEST(Tree, PriorsKeepElevenBits) {
    for (float prior = 1; prior > 1e-8f; prior *= 0.97f)
        EXPECT_NEAR(unpack_prior(pack_prior(prior)), prior, prior / 4000);
    EXPECT_EQ(unpack_prior(pack_prior(1)), 1.0f);
    EXPECT_EQ(unpack_prior(pack_prior(0)), 0.0f);
    EXPECT_EQ(unpack_prior(pack_prior(1e-30f)), 0.0f);
}

TEST(Tree, SumsStayExactPastTwoToThe24) {
    Tree tree(mebibyte);
    constexpr std::uint32_t visits = (1u << 24) + 1001;
    for (std::uint32_t i = 0; i < visits; ++i) {
        tree.enter_root();
        tree.back_up({tree.root()}, -1);
    }
    tree.enter_root();
    tree.back_up({tree.root()}, 0.25f);
    const Node& root = tree[tree.root()];
    EXPECT_EQ(root.visits, visits + 1);
    EXPECT_EQ(root.value_sum, (std::int64_t{visits} << 24) - (1 << 22));
}

TEST(Tree, SumsDoNotDependOnTheOrder) {
    Tree forward(mebibyte), backward(mebibyte);
    for (int i = 0; i < 1000; ++i) {
        forward.enter_root();
        forward.back_up({forward.root()}, std::sin(static_cast<float>(i)));
        backward.enter_root();
        backward.back_up({backward.root()}, std::sin(static_cast<float>(999 - i)));
    }
    EXPECT_EQ(forward[forward.root()].value_sum, backward[backward.root()].value_sum);
}

TEST(Tree, AValueCountsForTheOneWhoMovedThere) {
    Tree tree(mebibyte);
    expand_root(tree, 2);
    const NodeId child = visit_child(tree, 0, -1);  // lost for the player to move at the child
    EXPECT_EQ(tree[child].mean(), 1.0f);
    EXPECT_EQ(tree[tree.root()].mean(), -0.5f);  // one of two visits
}

TEST(Tree, ADescentUnderWayCountsAsALoss) {
    Tree tree(mebibyte);
    expand_root(tree, 2);
    const NodeId child = visit_child(tree, 0, -1);
    EXPECT_EQ(tree[child].mean(1), 0.0f);
    tree.enter_root();
    const Path path{tree.root(), tree.enter(tree.edges_to_enter(tree.root())[0])};
    EXPECT_EQ(tree[child].in_flight, 1u);
    tree.withdraw(path);
    EXPECT_EQ(tree[child].in_flight, 0u);
    EXPECT_EQ(tree[child].visits, 1u);
}

TEST(Tree, OneOfManyThreadsClaimsANode) {
    for (int round = 0; round < 50; ++round) {
        Tree tree(mebibyte);
        std::atomic<int> claims = 0;
        std::vector<std::thread> threads;
        for (int i = 0; i < 4; ++i)
            threads.emplace_back([&] { claims += tree.claim(tree.root()) ? 1 : 0; });
        for (auto& thread : threads) thread.join();
        EXPECT_EQ(claims, 1);
    }
}

TEST(Tree, AllThreadsEnterTheSameChild) {
    for (int round = 0; round < 50; ++round) {
        Tree tree(mebibyte);
        expand_root(tree, 1);
        std::vector<NodeId> entered(4);
        std::vector<std::thread> threads;
        for (auto& id : entered)
            threads.emplace_back([&] { id = tree.enter(tree.edges_to_enter(tree.root())[0]); });
        for (auto& thread : threads) thread.join();
        for (const NodeId id : entered) EXPECT_EQ(id, entered[0]);
        EXPECT_EQ(tree[entered[0]].in_flight, 4u);
    }
}

TEST(Tree, AmafCountsTheMoversMovesOnly) {
    Tree tree(mebibyte);
    expand_root(tree, 3);
    const std::vector<std::int8_t> firsts = {1, -1, 0};
    tree.add_amaf(tree.root(), firsts, 1, 1);
    tree.add_amaf(tree.root(), firsts, 1, -1);
    tree.add_amaf(tree.root(), firsts, 1, 0);
    tree.add_amaf(tree.root(), firsts, 1, 1);
    const auto edges = tree.edges(tree.root());
    EXPECT_EQ(edges[0].amaf.visits(), 4u);
    EXPECT_EQ(edges[0].amaf.mean(), 0.25f);
    EXPECT_EQ(edges[1].amaf.visits(), 0u);
    EXPECT_EQ(edges[2].amaf.visits(), 0u);
}

TEST(Tree, AmafKeepsItsMeanWhenItsCountIsFull) {
    AmafCount count;
    for (int i = 0; i < 200000; ++i) count.add(i % 4 == 0 ? -1.0f : 1.0f);
    EXPECT_GT(count.visits(), 10000u);
    EXPECT_NEAR(count.mean(), 0.5f, 0.01f);
    EXPECT_EQ(AmafCount{}.mean(), 0.0f);
}

TEST(Tree, AFlipKeepsTheRootAndWhatIsEnteredAfterIt) {
    Tree tree(mebibyte);
    expand_root(tree, 3);
    visit_child(tree, 0, -1);
    visit_child(tree, 1, 1);
    tree.flip();
    const auto edges = tree.edges(tree.root());
    ASSERT_EQ(edges.size(), 3u);
    EXPECT_EQ(tree[tree.root()].visits, 3u);
    const NodeId before = tree.child(tree.root(), edges[0]);
    ASSERT_NE(before, no_node);
    EXPECT_EQ(tree[before].mean(), 1.0f);
    EXPECT_EQ(tree.child(tree.root(), edges[2]), no_node);

    const NodeId after = visit_child(tree, 0, -1);
    EXPECT_NE(after, before);
    EXPECT_EQ(tree[after].visits, 2u);
    EXPECT_EQ(tree[before].visits, 1u);  // the passive half is not written to
}

TEST(Tree, ASecondFlipForgetsWhatWasNotEnteredBetween) {
    Tree tree(mebibyte);
    expand_root(tree, 2);
    visit_child(tree, 0, -1);
    visit_child(tree, 1, -1);
    tree.flip();
    visit_child(tree, 0, -1);
    tree.flip();
    const auto edges = tree.edges(tree.root());
    const NodeId kept = tree.child(tree.root(), edges[0]);
    ASSERT_NE(kept, no_node);
    EXPECT_EQ(tree[kept].visits, 2u);
    EXPECT_EQ(tree.child(tree.root(), edges[1]), no_node);
    EXPECT_EQ(tree[visit_child(tree, 1, 1)].visits, 1u);
}

// Builds long lines in a small budget for long enough that every half is reused many times.
TEST(Tree, NeverLeavesItsBudget) {
    Tree tree(mebibyte);
    engine::Random random(1);
    int flips = 0;
    for (int i = 0; i < 20000; ++i) {
        Path path{tree.root()};
        tree.enter_root();
        bool full = false;
        for (int depth = 0; depth < 6 && tree[path.back()].expanded() && !full; ++depth) {
            const auto edges = tree.edges_to_enter(path.back());
            const auto child = tree.enter(edges[static_cast<std::size_t>(random.below(50))]);
            full = child == no_node;
            if (!full) path.push_back(child);
        }
        if (!full && tree.claim(path.back())) full = !tree.expand(path.back(), moves(50), {});
        tree.back_up(path, 0.5f);
        EXPECT_LE(tree.share_used(), 1.0);
        if (full) tree.flip(), ++flips;
    }
    EXPECT_GT(flips, 5);
    EXPECT_EQ(tree[tree.root()].visits, 20000u);
    EXPECT_EQ(tree[tree.root()].in_flight, 0u);
}

TEST(Tree, AdvancingKeepsTheChild) {
    Tree tree(mebibyte);
    expand_root(tree, 3);
    const NodeId child = visit_child(tree, 1, 1);
    EXPECT_FALSE(tree.advance({2}));  // never visited
    EXPECT_EQ(tree[tree.root()].visits, 2u);
    EXPECT_TRUE(tree.advance({1}));
    EXPECT_EQ(tree.root(), child);
    EXPECT_EQ(tree[tree.root()].visits, 1u);
}

TEST(Tree, AdvancingIntoThePassiveHalfKeepsTheChild) {
    Tree tree(mebibyte);
    expand_root(tree, 3);
    visit_child(tree, 1, 1);
    tree.flip();
    EXPECT_TRUE(tree.advance({1}));
    EXPECT_EQ(tree[tree.root()].visits, 1u);
    tree.flip();
    EXPECT_EQ(tree[tree.root()].visits, 1u);
}

}  // namespace
}  // namespace search
