// Whatever this processor has, or is limited to by ONEDNN_MAX_CPU_ISA: a network runs in every
// precision that is asked for, in that or a more exact one.
#include "nn/backend.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "naive.h"
#include "nn/builders.h"
#include "random_positions.h"

namespace nn {
namespace {

constexpr int board = 9;

Graph tower(Attention attention) {
    TowerDescription about;
    about.facts.board = board;
    about.facts.blocks = 2;
    about.facts.channels = 32;
    about.planes = 17;
    about.policy_size = 82;
    about.attention = attention;
    about.wdl = about.ownership = true;
    engine::Random random(1);
    return build_tower(about, random);
}

TEST(Backend, ServesEveryPrecisionByItselfOrAMoreExactOne) {
    for (const auto attention :
         {Attention::none, Attention::squeeze_excitation, Attention::global_pooling})
        for (const auto& [wanted, bound] : {std::pair{Precision::fp32, 1e-3},
                                            {Precision::bf16, 0.1},
                                            {Precision::int8, 0.5},
                                            {Precision::int16, 0.1}}) {
            engine::Random random(2);
            const auto graph = tower(attention);
            const auto positions = random_positions(graph, board, 8, random);
            const auto calibration = calibrate(graph, std::span(&positions, 1));
            EXPECT_LE(served_precision(graph, wanted, board), wanted);
            const auto executor = compile(graph, wanted, calibration, board)->make_executor();
            EXPECT_LT(naive::worst_difference(graph, *executor, board, 3, random), bound)
                << name_of(wanted) << " as " << name_of(served_precision(graph, wanted, board));
        }
}

TEST(Backend, KeepsToTheLimitOfTheEnvironment) {
    const char* set = std::getenv("ONEDNN_MAX_CPU_ISA");
    const std::string limit(set ? set : "");
    const auto graph = tower(Attention::none);
    if (limit == "SSE41") {
        EXPECT_EQ(served_precision(graph, Precision::int16, board), Precision::fp32);
    } else if (limit == "AVX2") {
        EXPECT_EQ(served_precision(graph, Precision::int8, board), Precision::fp32);
        EXPECT_EQ(served_precision(graph, Precision::bf16, board), Precision::fp32);
    } else {
        GTEST_SKIP() << "no limit is set";
    }
}

TEST(Backend, SaysWhyAPrecisionIsNotServed) {
    const auto graph = tower(Attention::none);
    for (const auto precision :
         {Precision::fp32, Precision::bf16, Precision::int8, Precision::int16}) {
        const bool served = served_precision(graph, precision, board) == precision;
        EXPECT_EQ(why_not(graph, precision, board).empty(), served) << name_of(precision);
    }
}

TEST(Backend, FallsBackByTheGraph) {
    // A layer by layer network has no 3x3 convolutions for int16.
    engine::Random random(3);
    const auto graph = build_mlp({}, {4, 8, 2}, random);
    EXPECT_NE(served_precision(graph, Precision::int16, board), Precision::int16);
    EXPECT_FALSE(why_not(graph, Precision::int16, board).empty());
}

}  // namespace
}  // namespace nn
