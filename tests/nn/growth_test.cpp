#include "nn/growth.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "naive.h"
#include "nn/builders.h"
#include "nn/eigen/executor.h"
#include "training/problem.h"

namespace nn {
namespace {

TowerDescription tower(int blocks, int channels, Attention attention, bool any_board) {
    TowerDescription about;
    about.facts.game = any_board ? "go" : "chess";
    about.facts.board = any_board ? 0 : 8;
    about.facts.blocks = blocks;
    about.facts.channels = channels;
    about.planes = 5;
    about.globals = any_board ? 3 : 0;
    about.policy = any_board ? PolicyHead::points : PolicyHead::planes;
    about.move_planes = 7;
    about.attention = attention;
    about.flat_value = !any_board;
    about.value_width = 4 * blocks;
    about.wdl = true;
    about.ownership = about.score = any_board;
    return about;
}

// As if it had learned: no number is what a new network has there.
Graph trained(const TowerDescription& about) {
    engine::Random random(1);
    auto graph = build_tower(about, random);
    for (auto& node : graph.nodes)
        for (auto& tensor : node.weights)
            for (auto& value : tensor.values) value += 0.2f * naive::uniform(random);
    graph.facts.steps = 77;
    return graph;
}

Graph fresh(const TowerDescription& about) {
    engine::Random random(2);
    return build_tower(about, random);
}

TEST(Growth, ALargerNetworkFirstSaysWhatTheSmallOneDoes) {
    for (const bool any_board : {false, true})
        for (const auto attention :
             {Attention::none, Attention::squeeze_excitation, Attention::global_pooling}) {
            const auto small = trained(tower(2, 8, attention, any_board));
            const auto large = grown(small, fresh(tower(3, 12, attention, any_board)));
            ASSERT_TRUE(large);
            validate(*large);
            EXPECT_EQ(large->facts.steps, 77);
            EXPECT_EQ(large->facts.channels, 12);
            EXPECT_GT(parameter_count(*large), parameter_count(small));
            engine::Random random(3);
            const auto executor = eigen::Program(*large).make_executor();
            for (const int board : any_board ? std::vector{5, 9} : std::vector{8})
                EXPECT_LT(naive::worst_difference(small, *executor, board, 3, random), 1e-3)
                    << static_cast<int>(attention) << ' ' << board;
        }
}

TEST(Growth, WhatIsNewLearns) {
    const auto small = trained(tower(1, 8, Attention::global_pooling, true));
    const auto large = grown(small, fresh(tower(2, 12, Attention::global_pooling, true)));
    ASSERT_TRUE(large);
    const training::Problem problem(*large, 5, 16);
    training::LearnerSettings settings;
    settings.terms = training::usual_terms(*large);
    settings.optimiser.schedule.rate = 0.01f;
    training::Learner learner(*large, settings);
    for (int step = 0; step < 5; ++step) EXPECT_EQ(learner.step(problem.samples).fault, "");
    const auto after = learner.newest();
    for (std::size_t i = 0; i < after.nodes.size(); ++i) {
        const auto& node = after.nodes[i];
        if (node.operation != Operation::batch_norm || node.name.find("block1") != 0) continue;
        constexpr std::size_t scale = 2;
        EXPECT_NE(node.weights[scale], large->nodes[i].weights[scale]) << node.name;
    }
    // From new channels to old ones, where growth left zeros.
    const auto& kernel = *std::ranges::find(after.nodes, "block0.first", &Node::name);
    const auto first_new = kernel.weights[0].values.begin() + 8 * 9;
    EXPECT_TRUE(std::any_of(first_new, first_new + 4 * 9, [](float w) { return w != 0; }));
}

TEST(Growth, OnlyIntoTheSameDesignWithMore) {
    const auto about = tower(2, 8, Attention::none, true);
    const auto small = trained(about);
    const auto fits = [&](auto change) {
        auto other = about;
        change(other);
        return grown(small, fresh(other)).has_value();
    };
    EXPECT_TRUE(fits([](auto&) {}));
    EXPECT_TRUE(fits([](auto& other) { other.value_width = 20; }));
    EXPECT_FALSE(fits([](auto& other) { other.facts.blocks = 1; }));
    EXPECT_FALSE(fits([](auto& other) { other.facts.channels = 6; }));
    EXPECT_FALSE(fits([](auto& other) { other.attention = Attention::global_pooling; }));
    EXPECT_FALSE(fits([](auto& other) { other.planes = 6; }));
    EXPECT_FALSE(fits([](auto& other) { other.moves_left = true; }));
    EXPECT_FALSE(fits([](auto& other) { other.facts.encoding = "another"; }));
    // Nor from what bears the same names and is built otherwise.
    auto pointwise = small;
    auto& kernel = std::ranges::find(pointwise.nodes, "block0.second", &Node::name)->weights[0];
    kernel = {{8, 8, 1, 1}, std::vector<float>(64)};
    EXPECT_FALSE(grown(pointwise, fresh(about)));
    auto rewired = small;
    std::ranges::find(rewired.nodes, "value", &Node::name)->inputs[0] = 2;
    EXPECT_FALSE(grown(rewired, fresh(about)));
}

}  // namespace
}  // namespace nn
