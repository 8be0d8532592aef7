// All weights of a graph as one row of numbers, in the order of its nodes: gradients, states of an
// optimiser and averages are rows of the same length. A graph and its unfused form share one order.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nn/graph.h"

namespace nn::training {

enum class Role : std::uint8_t {
    matrix,     // of a convolution or a dense layer: what weight decay is for
    offset,     // biases, scales and shifts
    statistic,  // mean and variance of a batch norm: observed, never learned
};

struct Slot {
    int node = 0, weight = 0;  // Graph::nodes[node].weights[weight]
    std::size_t offset = 0, size = 0;
    Role role = Role::matrix;
};

class Parameters {
   public:
    explicit Parameters(const Graph& graph);

    std::size_t size() const { return size_; }
    std::span<const Slot> slots() const { return slots_; }
    std::size_t offset(int node, int weight) const;

    std::vector<float> read(const Graph& graph) const;
    void write(std::span<const float> row, Graph& graph) const;

   private:
    std::vector<Slot> slots_;
    std::vector<std::size_t> first_slot_;  // per node
    std::size_t size_ = 0;
};

}  // namespace nn::training
