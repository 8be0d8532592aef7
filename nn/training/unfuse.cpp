#include "nn/training/unfuse.h"

#include <utility>

#include "nn/compose.h"
#include "nn/index.h"

namespace nn::training {

namespace {

// How many inputs an operation has without a residual; of those that may carry one.
std::size_t own_inputs(const Node& node) {
    switch (node.operation) {
        case Operation::convolution:
        case Operation::dense:
            return 1;
        case Operation::squeeze_scale:
            return 2;
        default:
            return node.inputs.size();
    }
}

int append_unfused(Graph& graph, Node node) {
    const auto name = node.name;
    const auto own = own_inputs(node);
    const int residual = node.inputs.size() > own ? node.inputs[own] : -1;
    node.inputs.resize(own);
    auto activation = Activation::identity;
    if (node.operation != Operation::activation)
        activation = std::exchange(node.activation, Activation::identity);
    int last = graph.append(std::move(node));
    if (residual >= 0)
        last = add_operation(graph, Operation::add, name + ".residual", {last, residual});
    if (activation != Activation::identity)
        last = add_activation(graph, name + ".activation", last, activation);
    return last;
}

}  // namespace

Graph unfuse(const Graph& graph) {
    Graph plain;
    plain.facts = graph.facts;
    std::vector<int> moved;
    for (auto node : graph.nodes) {
        for (int& input : node.inputs) input = moved[at(input)];
        moved.push_back(append_unfused(plain, std::move(node)));
    }
    for (const auto& output : graph.outputs)
        plain.outputs.push_back({output.name, moved[at(output.node)]});
    return plain;
}

}  // namespace nn::training
