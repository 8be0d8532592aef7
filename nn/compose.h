// Shorthand for builders and importers: each function appends one operation to a graph and yields
// its index. Shapes are checked later, by validate.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "nn/graph.h"

namespace nn {

inline int add_input(Graph& graph, std::string name, Shape shape) {
    Node node{.operation = Operation::input, .name = std::move(name)};
    node.shape = shape;
    return graph.append(std::move(node));
}

inline int add_operation(Graph& graph, Operation operation, std::string name,
                         std::vector<int> inputs, std::vector<Tensor> weights = {}) {
    return graph.append({.operation = operation,
                         .name = std::move(name),
                         .inputs = std::move(inputs),
                         .weights = std::move(weights)});
}

inline int add_convolution(Graph& graph, std::string name, int input, std::vector<Tensor> weights) {
    return add_operation(graph, Operation::convolution, std::move(name), {input},
                         std::move(weights));
}

inline int add_dense(Graph& graph, std::string name, int input, std::vector<Tensor> weights) {
    return add_operation(graph, Operation::dense, std::move(name), {input}, std::move(weights));
}

inline constexpr float usual_epsilon = 1e-5f;  // of a batch norm of our own networks

// `weights` as Operation::batch_norm lists them.
inline int add_batch_norm(Graph& graph, std::string name, int input, std::vector<Tensor> weights,
                          float epsilon = usual_epsilon) {
    Node node{Operation::batch_norm, std::move(name), {input}, std::move(weights)};
    node.epsilon = epsilon;
    return graph.append(std::move(node));
}

inline int add_activation(Graph& graph, std::string name, int input, Activation activation) {
    Node node{Operation::activation, std::move(name), {input}, {}};
    node.activation = activation;
    return graph.append(std::move(node));
}

inline int add_pool(Graph& graph, std::string name, int input, Pooling pooling) {
    Node node{Operation::pool, std::move(name), {input}, {}};
    node.pooling = pooling;
    return graph.append(std::move(node));
}

inline int add_gather(Graph& graph, std::string name, int input, std::vector<int> table) {
    Node node{Operation::gather, std::move(name), {input}, {}};
    node.table = std::move(table);
    return graph.append(std::move(node));
}

inline void name_output(Graph& graph, std::string name, int node) {
    graph.outputs.push_back({std::move(name), node});
}

}  // namespace nn
