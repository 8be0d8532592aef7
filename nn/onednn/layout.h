// A network laid out for one board and one number format: which operations are layers of the
// library, in which format each reads, and the graph rewritten for rows of channels (a flattening
// before a dense layer or a gather is only another order of their indices). A plain value, made
// once a board and shared by all executors.
#pragma once

#include <array>
#include <vector>

#include "nn/calibration.h"
#include "nn/executor.h"
#include "nn/onednn/kernels.h"

namespace nn::onednn {

// Who computes an operation.
enum class Maker : std::uint8_t { loops, library };

struct Layout {
    Graph graph;  // optimised, with the same indices; not valid in the sense of validate
    int board = 0, points = 0;
    std::vector<Shape> shapes;
    std::vector<Maker> makers;
    std::vector<Format> reads;  // how a node reads its first input
    std::vector<int> uses;      // 0: nothing needs the node
    std::vector<std::array<bool, formats>> wanted;
    // Of a node wanted in u8 or s8: what one step is worth, per channel; and its inverse.
    std::vector<std::vector<float>> steps, inverse_steps;

    std::size_t size(int node) const { return shapes[static_cast<std::size_t>(node)].size(points); }
};

// `graph` is optimised. Fails with engine::Error when it does not serve the board. int8 needs a
// calibration.
Layout lay_out(const Graph& graph, Precision precision, const Calibration& calibration, int board);

}  // namespace nn::onednn
