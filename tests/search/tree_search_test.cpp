// TreeSearch by itself, on a toy game.
#include "search/tree_search.h"

#include <gtest/gtest.h>

#include "tests/search/tictactoe.h"

namespace search {
namespace {

using tictactoe::TicTacToe;

SearchParams small() {
    SearchParams params;
    params.memory_mib = 16;
    return params;
}

// As a network would that knows nothing.
void absorb_evenly(TreeSearch<TicTacToe>& search, Leaf<TicTacToe>& leaf) {
    leaf.priors.clear();
    leaf.value = 0;
    search.absorb(leaf);
}

// The first move of a descent that was told to begin with `code`; absorbs what it finds.
std::optional<engine::Move> first_move(TreeSearch<TicTacToe>& search, int code) {
    Leaf<TicTacToe> leaf;
    const engine::Move first{static_cast<std::uint16_t>(code)};
    EXPECT_EQ(search.gather(leaf, false, first), Gathered::leaf);
    absorb_evenly(search, leaf);
    if (leaf.line.empty()) return std::nullopt;
    return leaf.line[0];
}

TEST(TreeSearch, ADescentBeginsWithTheMoveThatWasGiven) {
    TreeSearch<TicTacToe> search(small(), true);
    EXPECT_EQ(first_move(search, 7), std::nullopt);  // the root has no moves yet
    for (const int code : {7, 7, 2, 7, 0}) EXPECT_EQ(first_move(search, code)->code, code);
    EXPECT_EQ(search.tree()[search.tree().root()].visits, 6u);
}

TEST(TreeSearch, NoiseChangesThePriorsAndNotTheirSum) {
    TreeSearch<TicTacToe> search(small(), true);
    Leaf<TicTacToe> leaf;
    ASSERT_EQ(search.gather(leaf, false), Gathered::leaf);
    absorb_evenly(search, leaf);
    engine::Random random(1);
    search.mix_root_noise(random, 0, 0.3f);
    for (const Edge& edge : search.tree().edges(search.tree().root()))
        EXPECT_NEAR(edge.prior(), 1 / 9.0f, 1e-4);
    search.mix_root_noise(random, 0.25f, 0.3f);
    float sum = 0, most = 0;
    for (const Edge& edge : search.tree().edges(search.tree().root())) {
        EXPECT_GE(edge.prior(), 0.75f / 9 - 1e-4f);
        sum += edge.prior();
        most = std::max(most, edge.prior());
    }
    EXPECT_NEAR(sum, 1, 1e-2);
    EXPECT_GT(most, 0.14f);
}

}  // namespace
}  // namespace search
