#include "nn/plan.h"

#include <algorithm>

#include "nn/index.h"

namespace nn {

namespace {

// The last node that reads each node's result; outputs and inputs live on to the end.
std::vector<int> last_uses(const Graph& graph) {
    std::vector<int> last(graph.nodes.size(), 0);
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
        last[i] = static_cast<int>(i);
        for (const int input : graph.nodes[i].inputs) last[at(input)] = static_cast<int>(i);
    }
    for (const auto& output : graph.outputs)
        last[at(output.node)] = static_cast<int>(graph.nodes.size());
    return last;
}

}  // namespace

int reusable_input(const Node& node) {
    switch (node.operation) {
        case Operation::convolution:
        case Operation::dense:
            return node.inputs.size() > 1 ? 1 : -1;
        case Operation::squeeze_scale:
            return node.inputs.size() > 2 ? 2 : 0;
        case Operation::batch_norm:
        case Operation::affine:
        case Operation::activation:
        case Operation::add:
        case Operation::add_vector:
        case Operation::point_bias:
            return 0;
        default:
            return -1;
    }
}

Plan plan_buffers(const Graph& graph, int board) {
    Plan plan{infer_shapes(graph, board), std::vector<int>(graph.nodes.size(), -1), {}};
    const auto last = last_uses(graph);
    std::vector<int> free;
    const auto take = [&](std::size_t size) {
        if (free.empty()) {
            free.push_back(static_cast<int>(plan.buffer_sizes.size()));
            plan.buffer_sizes.push_back(0);
        }
        const int buffer = free.back();
        free.pop_back();
        plan.buffer_sizes[at(buffer)] = std::max(plan.buffer_sizes[at(buffer)], size);
        return buffer;
    };
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
        const auto& node = graph.nodes[i];
        const int reused = reusable_input(node);
        const int source = reused < 0 ? -1 : node.inputs[at(reused)];
        const bool in_place = source >= 0 && last[at(source)] == static_cast<int>(i) &&
                              std::count(node.inputs.begin(), node.inputs.end(), source) == 1;
        plan.buffers[i] =
            in_place ? plan.buffers[at(source)] : take(plan.shapes[i].size(board * board));
        auto inputs = node.inputs;
        std::sort(inputs.begin(), inputs.end());
        inputs.erase(std::unique(inputs.begin(), inputs.end()), inputs.end());
        for (const int input : inputs)
            if (last[at(input)] == static_cast<int>(i) && !(in_place && input == source))
                free.push_back(plan.buffers[at(input)]);
        if (last[i] == static_cast<int>(i)) free.push_back(plan.buffers[i]);
    }
    return plan;
}

}  // namespace nn
