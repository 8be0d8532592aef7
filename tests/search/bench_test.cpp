#include "search/bench.h"

#include <gtest/gtest.h>

#include <cmath>

#include "search/selection.h"

namespace search {
namespace {

TEST(Bench, TheSignatureIsTheSameTwice) { EXPECT_EQ(signature(400), signature(400)); }
TEST(Bench, TheSignatureTellsSearchesApart) { EXPECT_NE(signature(400), signature(500)); }

TEST(Bench, FiguresHaveStableNames) {
    std::vector<std::string> names;
    for (const auto& figure : bench_search(0.02)) {
        EXPECT_GT(figure.value, 0) << figure.name;
        names.push_back(figure.name);
    }
    const std::vector<std::string> expected = {"signature",
                                               "go9_uct_sims",
                                               "go19_uct_sims",
                                               "chess_sims",
                                               "chess_sims_2_threads",
                                               "shogi_sims",
                                               "shogi_sims_2_threads",
                                               "go9_sims",
                                               "go9_sims_2_threads",
                                               "go19_sims",
                                               "go19_sims_2_threads",
                                               "node_bytes",
                                               "edge_bytes"};
    EXPECT_EQ(names, expected);
}

TEST(Selection, TheLogarithmIsRight) {
    for (float x = 1; x < 4e9f; x *= 1.37f) EXPECT_NEAR(portable_log(x), std::log(x), 2e-5) << x;
}

}  // namespace
}  // namespace search
