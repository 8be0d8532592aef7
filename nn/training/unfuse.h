// The opposite of nn/passes.h's fuse: every fused residual becomes an add, every fused activation
// an activation, so that whoever differentiates a graph meets each operation alone. Weights keep
// their order, outputs their meaning.
#pragma once

#include "nn/graph.h"

namespace nn::training {

Graph unfuse(const Graph& graph);

}  // namespace nn::training
