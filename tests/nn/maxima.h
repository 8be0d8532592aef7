// What calibration would see: the largest magnitudes that the reference executor finds.
#pragma once

#include <cmath>
#include <vector>

#include "nn/eigen/executor.h"
#include "nn/graph.h"

namespace nn {

// Per node of `optimised`, per channel, over `positions` positions given as for Executor::run.
inline std::vector<std::vector<float>> maxima_of(Graph optimised, int board,
                                                 const std::vector<std::vector<float>>& inputs,
                                                 int positions) {
    optimised.outputs.clear();
    for (std::size_t n = 0; n < optimised.nodes.size(); ++n)
        optimised.outputs.push_back({"", static_cast<int>(n)});
    const auto shapes = infer_shapes(optimised, board);
    const auto points = static_cast<std::size_t>(board * board);
    std::vector<std::vector<float>> results, maxima;
    for (const auto& shape : shapes)
        results.emplace_back(shape.size(board * board) * static_cast<std::size_t>(positions));
    const std::vector<std::span<const float>> in(inputs.begin(), inputs.end());
    const std::vector<std::span<float>> out(results.begin(), results.end());
    eigen::Program(optimised).make_executor()->run({positions, board, in, out});
    for (std::size_t n = 0; n < shapes.size(); ++n) {
        const auto channels = static_cast<std::size_t>(shapes[n].channels);
        const auto row = shapes[n].over_board ? points : 1;
        auto& most = maxima.emplace_back(channels, 0.0f);
        for (std::size_t i = 0; i < results[n].size(); ++i) {
            float& channel = most[i / row % channels];
            channel = std::max(channel, std::abs(results[n][i]));
        }
    }
    return maxima;
}

}  // namespace nn
