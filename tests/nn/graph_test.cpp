#include "nn/graph.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/base/error.h"
#include "naive.h"
#include "nn/builders.h"
#include "nn/compose.h"
#include "nn/eigen/executor.h"
#include "nn/passes.h"

namespace nn {
namespace {

std::string message_of(const Graph& graph) {
    try {
        validate(graph);
    } catch (const engine::Error& error) {
        return error.what();
    }
    return "";
}

Graph small() {
    Graph g;
    const int x = add_input(g, "planes", {2, true});
    const int y = add_convolution(
        g, "first", x,
        {{{3, 2, 3, 3}, std::vector<float>(54, 0.5f)}, {{3}, std::vector<float>(3, 1.0f)}});
    const int flat = add_operation(g, Operation::flatten, "flat", {y});
    name_output(g, "policy",
                add_dense(g, "policy", flat, {{{2, 75}, std::vector<float>(150, 0.1f)}}));
    g.facts.board = 5;
    return g;
}

TEST(Graph, CountsParametersAndOperations) {
    const auto g = small();
    validate(g);
    EXPECT_EQ(parameter_count(g), 54 + 3 + 150);
    EXPECT_EQ(flop_count(g, 5), 2 * 25 * 54 + 2 * 150);
}

TEST(Graph, InfersShapes) {
    const auto shapes = infer_shapes(small(), 5);
    EXPECT_EQ(shapes[1], (Shape{3, true}));
    EXPECT_EQ(shapes[2], (Shape{75, false}));
    EXPECT_EQ(shapes[3], (Shape{2, false}));
    EXPECT_EQ(shapes[1].size(25), 75u);
}

TEST(Graph, SaysWhichBoardDoesNotFit) {
    try {
        infer_shapes(small(), 6);
        FAIL();
    } catch (const engine::Error& error) {
        EXPECT_STREQ(error.what(),
                     "dense \"policy\": expected 75 numbers, found 108 on a board of 6");
    }
}

TEST(Graph, RefusesWhatIsWrongByName) {
    auto g = small();
    EXPECT_EQ(message_of(g), "");
    g.nodes[1].weights[0].shape = {3, 1, 3, 3};
    EXPECT_EQ(message_of(g),
              "convolution \"first\": expected weight of shape [3,2,3,3], found [3,1,3,3]");
    g = small();
    g.nodes[1].weights[1].values[2] = std::nanf("");
    EXPECT_EQ(message_of(g), "\"first\": expected finite weights, found nan");
    g = small();
    g.nodes[2].inputs = {3};
    EXPECT_EQ(message_of(g), "flatten \"flat\": input 3 is no earlier operation");
    g = small();
    g.nodes[2].name = "first";
    EXPECT_EQ(message_of(g), "expected names that differ, found \"first\" again");
    g = small();
    g.nodes[3].weights[0].values.pop_back();
    EXPECT_EQ(message_of(g), "\"policy\": shape [2,75] wants 150 numbers, found 149");
    g = small();
    g.outputs[0].node = 9;
    EXPECT_EQ(message_of(g), "output \"policy\": no operation 9");
    g = small();
    g.facts.board = 1000;
    EXPECT_EQ(message_of(g), "expected a board of 0 to 32, found 1000");
}

TEST(Graph, NamesGoBothWays) {
    for (int i = 0; i <= static_cast<int>(Operation::point_bias); ++i) {
        const auto operation = static_cast<Operation>(i);
        EXPECT_EQ(operation_from(name_of(operation)), operation);
    }
    EXPECT_EQ(activation_from("mish"), Activation::mish);
    EXPECT_EQ(pooling_from("mean_quadratic"), Pooling::mean_quadratic);
    EXPECT_FALSE(operation_from("transformer"));
}

TEST(Graph, ActivationsAtKnownPoints) {
    EXPECT_FLOAT_EQ(activate(Activation::relu, -2), 0);
    EXPECT_NEAR(activate(Activation::mish, 1), 0.865098f, 1e-6);
    EXPECT_NEAR(activate(Activation::silu, 1), 0.731059f, 1e-6);
    EXPECT_NEAR(activate(Activation::softplus, 0), 0.693147f, 1e-6);
    EXPECT_FLOAT_EQ(activate(Activation::softplus, 90), 90);
    EXPECT_FLOAT_EQ(activate(Activation::square_root, 9), 3);
    EXPECT_FLOAT_EQ(activate(Activation::sigmoid, 0), 0.5f);
}

TEST(Passes, FoldEveryBatchNormAndFuseWhatFollows) {
    engine::Random random(1);
    const auto g = optimise(naive::every_operation(random, 7));
    int residuals = 0;
    for (const auto& node : g.nodes) {
        EXPECT_NE(node.operation, Operation::batch_norm);
        EXPECT_NE(node.operation, Operation::activation);
        EXPECT_NE(node.operation, Operation::add);
        residuals += node.operation == Operation::convolution && node.inputs.size() == 2;
        residuals += node.operation == Operation::squeeze_scale && node.inputs.size() == 3;
    }
    EXPECT_EQ(residuals, 2);
    validate(g);
}

TEST(Passes, KeepWhatTheNetworkComputes) {
    engine::Random random(2);
    const auto original = naive::every_operation(random, 6);
    const auto optimised = optimise(original);
    const std::map<std::string, naive::Values> inputs = {{"planes", naive::Values(3 * 36, 0.25)},
                                                         {"globals", {1, -1, 0.5, 0}}};
    naive::Machine before{original, 6}, after{optimised, 6};
    before.run(inputs);
    after.run(inputs);
    for (const auto& output : original.outputs) {
        const auto& expected = before.results[naive::at(output.node)];
        const auto& found = after.results[naive::at(*optimised.output(output.name))];
        ASSERT_EQ(expected.size(), found.size());
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_NEAR(found[i], expected[i], 1e-4) << output.name << ' ' << i;
    }
}

// As a network learns on that has learned without norms.
TEST(Passes, BatchNormsThatAreUnfoldedChangeNothingAndFoldAgain) {
    engine::Random random(9);
    const auto plain = build_alphago_policy(naive::facts_of(5, 3, 6), 4, random);
    const auto normed = unfold_batch_norms(plain);
    validate(normed);
    const auto norms = std::ranges::count(normed.nodes, Operation::batch_norm, &Node::operation);
    EXPECT_EQ(norms, 3);
    EXPECT_EQ(parameter_count(normed), parameter_count(plain) + 3 * 3 * 6);
    const auto executor = eigen::Program(normed).make_executor();
    EXPECT_LT(naive::worst_difference(plain, *executor, 5, 4, random), 1e-4);
    const auto folded = fold_batch_norms(normed);
    EXPECT_EQ(folded.nodes.size(), plain.nodes.size());
    EXPECT_EQ(parameter_count(folded), parameter_count(plain));
}

TEST(Passes, DropWhatNoOutputNeeds) {
    auto g = small();
    add_activation(g, "unused", 1, Activation::relu);
    EXPECT_EQ(optimise(g).nodes.size(), small().nodes.size());
}

}  // namespace
}  // namespace nn
