// Our own network files: the safetensors layout (https://github.com/huggingface/safetensors), which
// Python's `safetensors` opens unchanged. The graph and the facts are JSON in the header's
// metadata under "sanban", a CRC-32 of that text and of all tensors under "checksum"; weights are
// F32 tensors called "operation.weight". A file may hold more rows of numbers:
// "calibration/operation", what quantised executors are to know, and "training/name", which are no
// part of the network.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "nn/calibration.h"
#include "nn/graph.h"

namespace nn {

bool is_safetensors(std::string_view bytes);

// Fails with engine::Error (what was expected, what was found) on anything but a whole, sound file;
// what it yields is valid.
Graph graph_from_safetensors(std::string_view bytes);

// Rows by name, without "training/".
using Extras = std::map<std::string, std::vector<float>>;

Extras extras_from_safetensors(std::string_view bytes);
// Empty when the file holds none that fits.
Calibration calibration_from_safetensors(std::string_view bytes, const Graph& graph);
std::string to_safetensors(const Graph& graph, const Extras& extras = {},
                           const Calibration& calibration = {});

}  // namespace nn
