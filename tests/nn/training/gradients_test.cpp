// The reference's gradients, operation by operation, against finite differences of double loops.
#include <gtest/gtest.h>

#include <numeric>

#include "case.h"
#include "nn/builders.h"

namespace nn::training {
namespace {

// At most `most` numbers of every weight, spread over it.
void expect_true_gradients(const Graph& graph, int board, int size, std::size_t most = 12) {
    GradientCase test(graph, board, size);
    const auto trainer = make_reference_trainer(graph);
    const auto found = test.gradients_by(*trainer);
    const Parameters parameters(graph);
    for (const auto& slot : parameters.slots()) {
        if (slot.role == Role::statistic) continue;
        double scale = 0;
        for (std::size_t i = 0; i < slot.size; ++i)
            scale = std::max(scale, std::abs(double{found[slot.offset + i]}));
        EXPECT_GT(scale, 0) << graph.nodes[at(slot.node)].name;
        for (std::size_t i = 0; i < slot.size; i += std::max<std::size_t>(slot.size / most, 1))
            EXPECT_NEAR(found[slot.offset + i], test.difference_by(slot.node, slot.weight, i),
                        1e-3 * scale + 1e-5)
                << graph.nodes[at(slot.node)].name << " weight " << slot.weight << " [" << i << ']';
    }
}

constexpr int board = 4;

// A layer with weights before the operation under test, so that what flows back through it shows.
struct Bench {
    engine::Random random{3};
    Graph graph;
    int planes, body, vector;

    Bench() {
        graph.facts.board = board;
        planes = add_input(graph, "planes", {3, true});
        const int globals = add_input(graph, "globals", {4, false});
        body = add_convolution(graph, "before", planes, {tensor({4, 3, 3, 3}), tensor({4})});
        vector = add_dense(graph, "vector", globals, {tensor({4, 4}), tensor({4})});
        name_output(graph, "body", body);
        name_output(graph, "vector", vector);
    }
    Tensor tensor(std::vector<int> shape) {
        return naive::random_tensor(random, std::move(shape), 0.6f);
    }
    void finish(int node, int size = 3) {
        name_output(graph, "result", node);
        expect_true_gradients(graph, board, size);
    }
};

TEST(Gradients, Convolution) {
    for (const int side : {1, 3, 5}) {
        Bench bench;
        bench.finish(add_convolution(bench.graph, "under test", bench.body,
                                     {bench.tensor({2, 4, side, side}), bench.tensor({2})}));
    }
}

TEST(Gradients, ConvolutionLargerThanTheBoard) {
    Bench bench;
    bench.finish(
        add_convolution(bench.graph, "under test", bench.body, {bench.tensor({2, 4, 9, 9})}));
}

TEST(Gradients, Dense) {
    Bench bench;
    bench.finish(add_dense(bench.graph, "under test", bench.vector,
                           {bench.tensor({5, 4}), bench.tensor({5})}));
}

TEST(Gradients, BatchNorm) {
    for (const bool over_board : {true, false}) {
        Bench bench;
        bench.finish(add_batch_norm(
            bench.graph, "under test", over_board ? bench.body : bench.vector,
            {bench.tensor({4}), {{4}, {1, 1, 1, 1}}, bench.tensor({4}), bench.tensor({4})}, 0.01f));
    }
}

TEST(Gradients, Affine) {
    Bench bench;
    bench.finish(add_operation(bench.graph, Operation::affine, "under test", {bench.body},
                               {bench.tensor({4}), bench.tensor({4})}));
}

TEST(Gradients, Activations) {
    for (const auto kind :
         {Activation::identity, Activation::relu, Activation::mish, Activation::silu,
          Activation::tanh, Activation::sigmoid, Activation::softplus, Activation::square_root}) {
        Bench bench;
        bench.finish(add_activation(bench.graph, "under test", bench.body, kind));
    }
}

TEST(Gradients, Additions) {
    Bench bench;
    const int sum = add_operation(bench.graph, Operation::add, "sum", {bench.body, bench.body});
    const int side = add_operation(bench.graph, Operation::add_vector, "side", {sum, bench.vector});
    bench.finish(add_operation(bench.graph, Operation::add, "under test", {side, bench.body}));
}

TEST(Gradients, Pools) {
    for (const auto kind : {Pooling::mean, Pooling::mean_maximum, Pooling::mean_quadratic}) {
        Bench bench;
        bench.finish(add_pool(bench.graph, "under test", bench.body, kind));
    }
}

TEST(Gradients, SqueezeScale) {
    Bench bench;
    const int z = add_dense(bench.graph, "excite", bench.vector, {bench.tensor({8, 4})});
    bench.finish(
        add_operation(bench.graph, Operation::squeeze_scale, "under test", {bench.body, z}));
}

TEST(Gradients, FlattenConcatenateGather) {
    Bench bench;
    const int flat = add_operation(bench.graph, Operation::flatten, "flat", {bench.body});
    const int all = add_operation(bench.graph, Operation::concatenate, "all", {flat, bench.vector});
    std::vector<int> table(60);
    for (int i = 0; i < 60; ++i) table[at(i)] = i * 7 % 68;
    bench.finish(add_gather(bench.graph, "under test", all, table));
}

TEST(Gradients, PointBias) {
    Bench bench;
    bench.finish(add_operation(bench.graph, Operation::point_bias, "under test", {bench.body},
                               {bench.tensor({4, board * board})}));
}

TEST(Gradients, FusedResidualsAndActivations) {
    Bench bench;
    Node node{Operation::convolution,
              "under test",
              {bench.body, bench.body},
              {bench.tensor({4, 4, 3, 3}), bench.tensor({4})}};
    node.activation = Activation::mish;
    bench.finish(bench.graph.append(node));
}

TEST(Gradients, EveryOperationAtOnceOnAnyBoardAndBatch) {
    for (const auto& [side, size] : {std::pair{3, 1}, {5, 4}}) {
        engine::Random random(2);
        expect_true_gradients(naive::every_operation(random, side), side, size, 4);
    }
}

TEST(Gradients, ForwardIsTheExecutorsWithRunningStatistics) {
    engine::Random random(4);
    const auto graph = naive::every_operation(random, 5);
    GradientCase test(graph, 5, 2);
    const auto trainer = make_reference_trainer(graph);
    trainer->load(Parameters(graph).read(graph));
    test.run(*trainer, Statistics::running);
    for (std::size_t o = 0; o < graph.outputs.size(); ++o) {
        naive::Machine machine{graph, 5};
        const auto first = [](const Row& row) {
            return naive::Values(row.begin(),
                                 row.begin() + static_cast<std::ptrdiff_t>(row.size() / 2));
        };
        machine.run({{"planes", first(test.inputs[0])}, {"globals", first(test.inputs[1])}});
        const auto& expected = machine.results[at(graph.outputs[o].node)];
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_NEAR(test.outputs[o][i], expected[i], 1e-4);
    }
}

TEST(Gradients, StatisticsAreSumsOverSamples) {
    Bench bench;
    const int norm = add_batch_norm(
        bench.graph, "norm", bench.body,
        {bench.tensor({4}), {{4}, {1, 1, 1, 1}}, bench.tensor({4}), bench.tensor({4})}, 0.01f);
    name_output(bench.graph, "result", norm);
    GradientCase test(bench.graph, board, 3);
    const auto trainer = make_reference_trainer(bench.graph);
    const auto row = test.gradients_by(*trainer);
    double sum = 0, squares = 0;  // of channel 1
    for (int i = 0; i < 3; ++i)
        for (int p = 0; p < 16; ++p) {
            const double x = test.outputs[0][at((i * 4 + 1) * 16 + p)];
            sum += x / 16;
            squares += x * x / 16;
        }
    const Parameters parameters(bench.graph);
    EXPECT_NEAR(row[parameters.offset(norm, 0) + 1], sum, 1e-4);
    EXPECT_NEAR(row[parameters.offset(norm, 1) + 1], squares, 1e-4);
}

}  // namespace
}  // namespace nn::training
