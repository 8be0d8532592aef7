#include "nn/calibration.h"

#include <gtest/gtest.h>

#include "naive.h"
#include "nn/passes.h"
#include "random_positions.h"

namespace nn {
namespace {

TEST(Calibration, HoldsWhatTheLoopsReach) {
    constexpr int board = 5, size = 3;
    engine::Random random(1);
    const auto graph = naive::every_operation(random, board);
    const auto positions = random_positions(graph, board, size, random);
    const auto found = calibrate(graph, std::span(&positions, 1)).maxima;
    const auto optimised = optimise(graph);
    std::vector<std::vector<double>> expected(optimised.nodes.size());
    for (int i = 0; i < size; ++i) {
        naive::Machine machine{optimised, board};
        std::map<std::string, naive::Values> inputs;
        std::size_t next = 0;
        for (const int n : optimised.input_nodes()) {
            const auto& all = positions.inputs[next++];
            const auto each = static_cast<std::ptrdiff_t>(all.size() / size);
            inputs[optimised.nodes[naive::at(n)].name] =
                naive::Values(all.begin() + each * i, all.begin() + each * (i + 1));
        }
        machine.run(inputs);
        for (std::size_t n = 0; n < expected.size(); ++n) {
            const auto channels = naive::at(machine.shapes[n].channels);
            expected[n].resize(channels);
            const auto& values = machine.results[n];
            for (std::size_t v = 0; v < values.size(); ++v) {
                auto& most = expected[n][v / (values.size() / channels)];
                most = std::max(most, std::abs(values[v]));
            }
        }
    }
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t n = 0; n < found.size(); ++n) {
        ASSERT_EQ(found[n].size(), expected[n].size()) << n;
        for (std::size_t c = 0; c < found[n].size(); ++c)
            EXPECT_NEAR(found[n][c], expected[n][c], 2e-4) << optimised.nodes[n].name;
    }
}

TEST(Calibration, OfNothingIsEmpty) {
    engine::Random random(2);
    EXPECT_TRUE(calibrate(naive::every_operation(random, 5), {}).maxima.empty());
}

}  // namespace
}  // namespace nn
