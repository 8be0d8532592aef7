// Numbers at random where encoded positions would be.
#pragma once

#include "naive.h"
#include "nn/calibration.h"

namespace nn {

inline Positions random_positions(const Graph& graph, int board, int size, engine::Random& random) {
    Positions positions{size, board, {}};
    const auto shapes = infer_shapes(graph, board);
    for (const int n : graph.input_nodes())
        positions.inputs.push_back(
            naive::random_tensor(random,
                                 {size, static_cast<int>(shapes[naive::at(n)].size(board * board))})
                .values);
    return positions;
}

}  // namespace nn
