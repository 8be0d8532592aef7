// How large the numbers inside a network get: what quantised executors take their scales from.
// Measured by the reference executor on positions that the caller encoded.
#pragma once

#include <span>
#include <vector>

#include "nn/graph.h"

namespace nn {

// Encoded positions of one board size: per input of the graph the numbers of all positions, as
// Batch wants them.
struct Positions {
    int size = 0;
    int board = 0;
    std::vector<std::vector<float>> inputs;
};

// Per node of optimise(graph), per channel: the largest |number| that the node yielded. A plain
// value; empty when nothing was measured.
struct Calibration {
    std::vector<std::vector<float>> maxima;
    bool operator==(const Calibration&) const = default;
};

// Fails with engine::Error when the network does not serve a board. Takes about as long as one
// evaluation by the reference executor for each position.
Calibration calibrate(const Graph& graph, std::span<const Positions> batches);

}  // namespace nn
