// How large the numbers inside a network get: what quantised executors take their scales from.
// Measured in fp32 on positions that the caller encoded.
#pragma once

#include <map>
#include <span>
#include <string>
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

// Per node of optimise(graph), per channel: the largest |number| that the node yielded; of a vector
// whose length depends on the board, that of the largest. A plain value; empty when nothing was
// measured.
struct Calibration {
    std::vector<std::vector<float>> maxima;
    bool operator==(const Calibration&) const = default;
};

// Fails with engine::Error when the network does not serve a board. Takes about as long as one
// evaluation in fp32 for each position.
Calibration calibrate(const Graph& graph, std::span<const Positions> batches);

// The same by the names of nodes, as files keep it.
using NamedMaxima = std::map<std::string, std::vector<float>>;
NamedMaxima named_maxima(const Graph& graph, const Calibration& calibration);
// Empty when the rows are not those of this graph, or hold what no maximum can be.
Calibration calibration_from(const Graph& graph, const NamedMaxima& rows);

}  // namespace nn
