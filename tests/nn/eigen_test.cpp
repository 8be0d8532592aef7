#include <gtest/gtest.h>

#include <thread>

#include "engine/base/error.h"
#include "naive.h"
#include "nn/eigen/executor.h"

namespace nn {
namespace {

TEST(Eigen, EveryOperationAgreesWithTheLoops) {
    for (const int board : {3, 7, 9, 19}) {
        engine::Random random(static_cast<std::uint64_t>(board));
        const auto graph = naive::every_operation(random, board);
        validate(graph);
        const auto executor = eigen::Program(graph).make_executor();
        EXPECT_LT(naive::worst_difference(graph, *executor, board, 2, random), 2e-4)
            << "board " << board;
    }
}

TEST(Eigen, OneNetworkServesBoardsAndBatchesInAnyOrder) {
    engine::Random random(5);
    Graph g;
    int x = add_input(g, "planes", {4, true});
    x = add_convolution(g, "a", x, {naive::random_tensor(random, {8, 4, 3, 3}, 0.3f)});
    const int y = add_activation(g, "a.relu", x, Activation::relu);
    x = add_convolution(g, "b", y, {naive::random_tensor(random, {8, 8, 3, 3}, 0.3f)});
    x = add_operation(g, Operation::add, "sum", {y, x});
    x = add_pool(g, "pool", x, Pooling::mean_maximum);
    name_output(g, "value", add_dense(g, "v", x, {naive::random_tensor(random, {3, 24}, 0.3f)}));
    name_output(g, "body", y);
    const auto executor = eigen::Program(g).make_executor();
    for (const auto& [board, size] : {std::pair{9, 3}, {19, 1}, {7, 8}, {9, 1}, {2, 5}})
        EXPECT_LT(naive::worst_difference(g, *executor, board, size, random), 1e-4);
}

TEST(Eigen, ExecutorsOfOneProgramRunSideBySide) {
    engine::Random random(6);
    const auto graph = naive::every_operation(random, 5);
    const eigen::Program program(graph);
    std::array<double, 3> worst{};
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < worst.size(); ++t)
        threads.emplace_back([&, t] {
            engine::Random own(t);
            const auto executor = program.make_executor();
            for (int i = 0; i < 20; ++i)
                worst[t] = std::max(worst[t], naive::worst_difference(graph, *executor, 5, 2, own));
        });
    for (auto& thread : threads) thread.join();
    for (const double difference : worst) EXPECT_LT(difference, 2e-4);
}

TEST(Eigen, RefusesABoardThatDoesNotFit) {
    engine::Random random(7);
    const auto graph = naive::every_operation(random, 5);
    const auto executor = eigen::Program(graph).make_executor();
    EXPECT_THROW(naive::worst_difference(graph, *executor, 6, 1, random), engine::Error);
}

}  // namespace
}  // namespace nn
