#include "nn/training/parameters.h"

#include <algorithm>
#include <cassert>

#include "nn/index.h"

namespace nn::training {

namespace {

Role role_of(Operation operation, int weight) {
    if (operation == Operation::batch_norm && weight < 2) return Role::statistic;
    const bool layer = operation == Operation::convolution || operation == Operation::dense;
    return layer && weight == 0 ? Role::matrix : Role::offset;
}

}  // namespace

Parameters::Parameters(const Graph& graph) {
    for (int n = 0; n < static_cast<int>(graph.nodes.size()); ++n) {
        const auto& node = graph.nodes[at(n)];
        first_slot_.push_back(slots_.size());
        for (int w = 0; w < static_cast<int>(node.weights.size()); ++w) {
            const auto count = node.weights[at(w)].values.size();
            slots_.push_back({n, w, size_, count, role_of(node.operation, w)});
            size_ += count;
        }
    }
}

std::size_t Parameters::offset(int node, int weight) const {
    return slots_[first_slot_[at(node)] + at(weight)].offset;
}

std::vector<float> Parameters::read(const Graph& graph) const {
    std::vector<float> row;
    row.reserve(size_);
    for (const auto& node : graph.nodes)
        for (const auto& tensor : node.weights)
            row.insert(row.end(), tensor.values.begin(), tensor.values.end());
    assert(row.size() == size_);
    return row;
}

void Parameters::write(std::span<const float> row, Graph& graph) const {
    assert(row.size() == size_);
    for (const auto& slot : slots_)
        std::copy_n(row.begin() + static_cast<std::ptrdiff_t>(slot.offset), slot.size,
                    graph.nodes[at(slot.node)].weights[at(slot.weight)].values.begin());
}

}  // namespace nn::training
