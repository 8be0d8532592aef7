// TreeSearch by itself, on a toy game.
#include "search/tree_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

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

std::vector<float> root_priors(const TreeSearch<TicTacToe>& search) {
    std::vector<float> priors;
    for (const Edge& edge : search.tree().edges(search.tree().root()))
        priors.push_back(edge.prior());
    return priors;
}

TEST(TreeSearch, NoiseChangesThePriorsAndNotTheirSum) {
    TreeSearch<TicTacToe> search(small(), true);
    EXPECT_EQ(first_move(search, 0), std::nullopt);
    engine::Random random(1);
    search.mix_root_noise(random, 0, 0.3f);
    EXPECT_NEAR(root_priors(search).at(4), 1 / 9.0f, 1e-4);
    search.mix_root_noise(random, 0.25f, 0.3f);
    const auto priors = root_priors(search);
    EXPECT_GE(*std::min_element(priors.begin(), priors.end()), 0.75f / 9 - 1e-4f);
    EXPECT_GT(*std::max_element(priors.begin(), priors.end()), 0.14f);
    EXPECT_NEAR(std::accumulate(priors.begin(), priors.end(), 0.0f), 1, 1e-2);
}

}  // namespace
}  // namespace search
