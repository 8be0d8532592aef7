// A graph with random inputs and random gradients of its outputs, and what a trainer makes of them.
#pragma once

#include "naive_batch.h"
#include "nn/training/trainer.h"
#include "nn/training/unfuse.h"

namespace nn::training {

using naive::at;
using Row = std::vector<float>;

struct GradientCase {
    GradientCase(const Graph& of, int side, int samples, std::uint64_t seed = 1)
        : graph(of), board(side), size(samples) {
        engine::Random random(seed);
        const auto shapes = infer_shapes(graph, board);
        const auto fill = [&](int n) {
            const auto count = static_cast<int>(shapes[at(n)].size(board * board));
            return naive::random_tensor(random, {size, count}).values;
        };
        for (const int n : graph.input_nodes()) inputs.push_back(fill(n));
        for (const auto& output : graph.outputs) {
            factors.push_back(fill(output.node));
            outputs.emplace_back(factors.back().size());
        }
    }

    // Forward and backward once; leaves the outputs here.
    Row gradients_by(Trainer& trainer) {
        const Parameters parameters(graph);
        Row row(parameters.size());
        trainer.load(parameters.read(graph));
        run(trainer, Statistics::of_batch);
        trainer.backward(std::vector<std::span<const float>>(factors.begin(), factors.end()));
        trainer.collect(row);
        return row;
    }

    void run(Trainer& trainer, Statistics statistics) {
        const std::vector<std::span<const float>> in(inputs.begin(), inputs.end());
        const std::vector<std::span<float>> out(outputs.begin(), outputs.end());
        trainer.forward({size, board, in, out}, statistics);
    }

    // The derivative of the weighted sum of the outputs by one weight, by central differences.
    double difference_by(int node, int weight, std::size_t index) const {
        constexpr float step = 1e-4f;
        const auto shifted = [&](float shift, double& place) {
            Graph changed = graph;
            auto& value = changed.nodes[at(node)].weights[at(weight)].values[index];
            value += shift;
            place = value;
            const Graph plain = unfuse(changed);
            naive::BatchMachine machine{plain, board, size};
            machine.run(inputs);
            return machine.weighted_sum(factors);
        };
        double above = 0, below = 0;
        const double high = shifted(step, above), low = shifted(-step, below);
        return (high - low) / (above - below);
    }

    Graph graph;
    int board, size;
    std::vector<Row> inputs, factors, outputs;
};

}  // namespace nn::training
