#include "search/analysis.h"

#include <gtest/gtest.h>

namespace search {
namespace {

using engine::MoveList;

constexpr std::size_t mebibyte = std::size_t{1} << 20;

// A root of three moves, of which each visit's value is given.
class Root {
   public:
    Root() {
        MoveList moves;
        for (std::uint16_t code = 0; code < 3; ++code) moves.push({code});
        tree.enter_root();
        EXPECT_TRUE(tree.claim(tree.root()));
        EXPECT_TRUE(tree.expand(tree.root(), moves, {}));
        tree.back_up({tree.root()}, 0);
    }
    void visit(std::size_t move, float value, int times = 1) {
        for (int i = 0; i < times; ++i) {
            tree.enter_root();
            const NodeId child = tree.enter(tree.edges_to_enter(tree.root())[move]);
            tree.back_up({tree.root(), child}, -value);
        }
    }
    void mark(std::size_t move, Ending ending) {
        tree.mark(tree.child(tree.root(), tree.edges(tree.root())[move]), ending);
    }
    std::vector<int> order(const Telling& telling) const {
        std::vector<int> codes;
        for (const auto& move : describe_moves(tree, {}, telling)) codes.push_back(move.move.code);
        return codes;
    }

    Tree tree{mebibyte};
};

using Order = std::vector<int>;

Telling by_bound() {
    Telling telling;
    telling.by_bound = true;
    return telling;
}

TEST(Analysis, TheBoundPrefersAMoveThatIsBetterForSure) {
    Root root;
    for (int i = 0; i < 50; ++i) {
        root.visit(0, 0.6f);
        root.visit(0, -0.6f);
    }
    root.visit(1, 0.3f, 60);
    EXPECT_EQ(root.order({}), (Order{0, 1, 2}));
    EXPECT_EQ(root.order(by_bound()), (Order{1, 0, 2}));
}

TEST(Analysis, TheBoundTrustsNoHandfulOfVisits) {
    Root root;
    root.visit(0, 0.1f, 100);
    root.visit(1, 0.9f, 10);
    EXPECT_EQ(root.order(by_bound()), (Order{0, 1, 2}));
}

TEST(Analysis, TheVarianceIsThatOfTheValues) {
    Root root;
    for (int i = 0; i < 500; ++i) {
        root.visit(0, 0.5f);
        root.visit(0, -0.1f);
    }
    const auto& node =
        root.tree[root.tree.child(root.tree.root(), root.tree.edges(root.tree.root())[0])];
    EXPECT_NEAR(node.variance(), 0.09, 0.002);
}

TEST(Analysis, SureWinsComeFirstAndSureLossesLast) {
    Root root;
    root.visit(0, 0.5f, 50);
    root.visit(1, 0.2f, 20);
    root.visit(2, 1, 1);
    root.mark(0, Ending::win);   // the opponent's
    root.mark(2, Ending::loss);  // likewise
    EXPECT_EQ(root.order(by_bound()), (Order{2, 1, 0}));
    const auto now = standing(root.tree, {});
    EXPECT_TRUE(now.decided);
    EXPECT_EQ(now.first, Move{2});
    EXPECT_EQ(now.value, 1.0f);
}

TEST(Analysis, TheMoveThatWasChosenComesFirst) {
    Root root;
    root.visit(0, 0.5f, 50);
    Telling telling;
    telling.first = Move{2};
    telling.most_moves = 2;
    EXPECT_EQ(root.order(telling), (Order{2, 0}));
}

TEST(Analysis, OneMoveThatDoesNotLoseIsDecided) {
    Root root;
    for (std::size_t move = 0; move < 3; ++move) root.visit(move, 0, 5);
    EXPECT_FALSE(standing(root.tree, {}).decided);
    root.mark(0, Ending::win);
    EXPECT_FALSE(standing(root.tree, {}).decided);
    root.mark(1, Ending::win);
    EXPECT_TRUE(standing(root.tree, {}).decided);
    EXPECT_EQ(standing(root.tree, {}).first, Move{2});
}

TEST(Analysis, AMeanInSixteenBitsIsRight) {
    SmallMean mean;
    for (std::uint32_t i = 1; i <= 20000; ++i) mean.add(i % 5 == 0 ? 1.0f : 0.1f, i);
    EXPECT_NEAR(mean.value(), 0.28, 0.002);
}

}  // namespace
}  // namespace search
