#include "nn/builders.h"

#include <gtest/gtest.h>

#include "engine/base/error.h"
#include "naive.h"
#include "nn/eigen/executor.h"
#include "nn/load.h"
#include "nn/safetensors.h"

namespace nn {
namespace {

TowerDescription small_tower() {
    TowerDescription about;
    about.facts.board = 5;
    about.facts.blocks = 2;
    about.facts.channels = 8;
    about.planes = 3;
    about.policy_size = 26;
    about.value_width = 16;
    return about;
}

// The network as built, saved and read again, computes what the loops do.
void expect_sound(const Graph& graph, int board) {
    EXPECT_EQ(graph_from_bytes(to_safetensors(graph)), graph);
    engine::Random random(1);
    const auto executor = eigen::Program(graph).make_executor();
    EXPECT_LT(naive::worst_difference(graph, *executor, board, 2, random), 1e-3);
}

TEST(Builders, TowerOfAlphaGoZero) {
    engine::Random random(1);
    TowerDescription about;
    about.facts.board = 19;
    about.facts.blocks = 19;
    about.facts.channels = 16;
    about.planes = 17;
    about.policy_size = 362;
    const auto graph = build_tower(about, random);
    std::int64_t expected = 17 * 16 * 9 + 4 * 16;      // first convolution and norm
    expected += 19 * 2 * (16 * 16 * 9 + 4 * 16);       // blocks
    expected += 16 * 2 + 4 * 2 + 2 * 361 * 362 + 362;  // policy
    expected += 16 + 4 + 361 * 256 + 256 + 256 + 1;    // value
    EXPECT_EQ(parameter_count(graph), expected);
}

TEST(Builders, EveryOptionOfATowerRuns) {
    for (const auto attention :
         {Attention::none, Attention::squeeze_excitation, Attention::global_pooling})
        for (const bool any_board : {false, true}) {
            engine::Random random(2);
            auto about = small_tower();
            about.attention = attention;
            about.globals = 4;
            about.wdl = about.ownership = about.score = about.moves_left = true;
            if (any_board) {
                about.facts.board = 0;
                about.policy = PolicyHead::points;
                about.flat_value = false;
            }
            const auto graph = build_tower(about, random);
            for (const char* name : {"policy", "wdl", "ownership", "score", "moves_left"})
                EXPECT_TRUE(graph.output(name)) << name;
            expect_sound(graph, 5);
            if (any_board) expect_sound(graph, 9);
        }
}

TEST(Builders, PlanesOfMoves) {
    engine::Random random(3);
    auto about = small_tower();
    about.facts.board = 8;
    about.policy = PolicyHead::planes;
    about.move_planes = 73;
    const auto graph = build_tower(about, random);
    const auto shapes = infer_shapes(graph, 8);
    EXPECT_EQ(shapes[static_cast<std::size_t>(*graph.output("policy"))].channels, 73 * 64);
}

TEST(Builders, AlphaGo) {
    engine::Random random(4);
    Facts facts;
    facts.board = 9;
    facts.channels = 12;
    const auto policy = build_alphago_policy(facts, 48, random);
    EXPECT_EQ(parameter_count(policy), 48 * 12 * 25 + 12 + 11 * (12 * 12 * 9 + 12) + 12 + 81 + 2);
    expect_sound(policy, 9);
    const auto value = build_alphago_value(facts, 49, random);
    EXPECT_EQ(parameter_count(value),
              49 * 12 * 25 + 12 + 11 * (12 * 12 * 9 + 12) + 12 + 1 + 81 * 256 + 256 + 256 + 1);
    expect_sound(value, 9);
    const auto pooled = build_alphago_value(facts, 49, random, 8);
    EXPECT_EQ(parameter_count(pooled), parameter_count(value) - 13 + 8 * 13 - (81 - 8) * 256);
    expect_sound(pooled, 9);
}

TEST(Builders, Mlp) {
    engine::Random random(5);
    const auto graph = build_mlp({}, {4, 32, 32, 3}, random);
    EXPECT_EQ(parameter_count(graph), 4 * 32 + 32 + 32 * 32 + 32 + 32 * 3 + 3);
    expect_sound(graph, 9);
}

TEST(Builders, SeedsReproduce) {
    engine::Random one(6), same(6), other(7);
    EXPECT_EQ(build_tower(small_tower(), one), build_tower(small_tower(), same));
    EXPECT_NE(build_tower(small_tower(), one), build_tower(small_tower(), other));
}

TEST(Builders, RefuseWhatCannotBe) {
    engine::Random random(8);
    auto about = small_tower();
    about.facts.board = 0;
    EXPECT_THROW(build_tower(about, random), engine::Error);
    about = small_tower();
    about.facts.channels = 0;
    EXPECT_THROW(build_tower(about, random), engine::Error);
    EXPECT_THROW(build_mlp({}, {4}, random), engine::Error);
    EXPECT_THROW(build_mlp({}, {4, 0, 2}, random), engine::Error);
}

}  // namespace
}  // namespace nn
