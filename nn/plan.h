// Where an executor keeps the result of every operation: buffers are used again as soon as nothing
// needs what they hold, and additions happen in place.
#pragma once

#include <vector>

#include "nn/graph.h"

namespace nn {

struct Plan {
    std::vector<Shape> shapes;              // per node
    std::vector<int> buffers;               // per node: index into buffer_sizes
    std::vector<std::size_t> buffer_sizes;  // in numbers for one position
};

// The input whose buffer a node's result may take when nothing later needs it, or -1: that of an
// elementwise operation, or a fused residual.
int reusable_input(const Node& node);

Plan plan_buffers(const Graph& graph, int board);

}  // namespace nn
