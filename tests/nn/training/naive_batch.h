// A whole batch through the loops of ../naive.h in double, with the batch's own statistics in batch
// norms: what gradients are checked against by finite differences.
#pragma once

#include "../naive.h"
#include "nn/training/parameters.h"

namespace nn::naive {

inline double smooth(Activation activation, double x) {
    const double softplus = x > 30 ? x : std::log1p(std::exp(x));
    switch (activation) {
        case Activation::identity:
            return x;
        case Activation::relu:
            return std::max(x, 0.0);
        case Activation::mish:
            return x * std::tanh(softplus);
        case Activation::silu:
            return x / (1 + std::exp(-x));
        case Activation::tanh:
            return std::tanh(x);
        case Activation::sigmoid:
            return 1 / (1 + std::exp(-x));
        case Activation::softplus:
            return softplus;
        case Activation::square_root:
            return std::sqrt(std::max(x, 0.0));
    }
    return x;
}

struct BatchMachine {
    const Graph& graph;  // without fused residuals
    int board, size;
    std::vector<Machine> machines = {};

    void batch_norm(std::size_t n, Shape shape) {
        const auto& node = graph.nodes[n];
        const int points = shape.over_board ? board * board : 1;
        for (int c = 0; c < shape.channels; ++c) {
            double sum = 0, squares = 0;
            for (auto& machine : machines)
                for (int p = 0; p < points; ++p)
                    sum += machine.input(node, 0)[at(c * points + p)] / (points * size);
            for (auto& machine : machines)
                for (int p = 0; p < points; ++p)
                    squares += std::pow(machine.input(node, 0)[at(c * points + p)] - sum, 2) /
                               (points * size);
            for (auto& machine : machines)
                for (int p = 0; p < points; ++p) {
                    auto& y = machine.results[n];
                    y.resize(at(shape.channels * points));
                    y[at(c * points + p)] = (machine.input(node, 0)[at(c * points + p)] - sum) /
                                                std::sqrt(squares + node.epsilon) *
                                                machine.weight(node, 2, c) +
                                            machine.weight(node, 3, c);
                }
        }
    }

    // `inputs` in the order of Graph::input_nodes, sample after sample.
    void run(const std::vector<std::vector<float>>& inputs) {
        machines.clear();
        for (int i = 0; i < size; ++i) machines.push_back({graph, board});
        std::size_t next = 0;
        for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
            const auto& node = graph.nodes[n];
            const auto shape = machines[0].shapes[n];
            const auto count = shape.size(board * board);
            if (node.operation == Operation::batch_norm) batch_norm(n, shape);
            for (std::size_t i = 0; i < machines.size(); ++i) {
                auto& result = machines[i].results[n];
                if (node.operation == Operation::input) {
                    const auto* from = inputs[next].data() + i * count;
                    result = Values(from, from + count);
                } else if (node.operation != Operation::batch_norm) {
                    result = machines[i].compute(node, shape);
                }
                for (auto& x : result) x = smooth(node.activation, x);
            }
            if (node.operation == Operation::input) ++next;
        }
    }

    // The sum over all outputs, each number with its factor.
    double weighted_sum(const std::vector<std::vector<float>>& factors) const {
        double sum = 0;
        for (std::size_t o = 0; o < graph.outputs.size(); ++o)
            for (std::size_t i = 0; i < machines.size(); ++i) {
                const auto& result = machines[i].results[at(graph.outputs[o].node)];
                for (std::size_t j = 0; j < result.size(); ++j)
                    sum += result[j] * factors[o][i * result.size() + j];
            }
        return sum;
    }
};

}  // namespace nn::naive
