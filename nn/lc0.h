// lc0's network files (already unpacked): residual networks with or without squeeze-excitation,
// classical or convolutional policies, one value or win-draw-loss. The layout is pblczero.Net of
// lc0's proto/net.proto. Attention networks, ONNX files and other inputs than the classical 112
// planes are refused by name.
#pragma once

#include <string_view>
#include <vector>

#include "nn/graph.h"

namespace nn {

bool is_lc0(std::string_view bytes);

// Fails with engine::Error; what it yields is valid. Its policy is lc0's list of 1858 moves.
Graph graph_from_lc0(std::string_view bytes);

// Where each of the 1858 moves stands in a convolutional policy (plane * 64 + square of origin).
std::vector<int> lc0_policy_map();

}  // namespace nn
