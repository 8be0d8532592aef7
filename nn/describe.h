// What a network is, for people: the text of `sanban show`.
#pragma once

#include <string>

#include "nn/graph.h"

namespace nn {

// "name value" lines: the facts, the shapes of inputs and outputs, the parameters, and the cost of
// one position on the network's board (on 9x9 and 19x19 when it serves any).
std::string describe(const Graph& graph);

}  // namespace nn
