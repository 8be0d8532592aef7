// Every operation as its definition says, loop by loop, in double: what executors are compared
// with. And small random networks to compare them on.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "engine/base/random.h"
#include "nn/compose.h"
#include "nn/executor.h"
#include "nn/graph.h"

namespace nn::naive {

using Values = std::vector<double>;

inline std::size_t at(int index) { return static_cast<std::size_t>(index); }

inline Facts facts_of(int board, int blocks, int channels) {
    Facts facts;
    facts.board = board;
    facts.blocks = blocks;
    facts.channels = channels;
    return facts;
}

struct Machine {
    const Graph& graph;
    int board;
    std::vector<Shape> shapes = infer_shapes(graph, board);
    std::vector<Values> results = std::vector<Values>(graph.nodes.size());

    int points() const { return board * board; }
    const Values& input(const Node& node, int i) const { return results[at(node.inputs[at(i)])]; }
    double weight(const Node& node, int i, int index) const {
        return node.weights[at(i)].values[at(index)];
    }

    Values convolution(const Node& node) const {
        const int outs = node.weights[0].shape[0], ins = node.weights[0].shape[1];
        const int side = node.weights[0].shape[2];
        Values out;
        for (int o = 0; o < outs; ++o)
            for (int y = 0; y < board; ++y)
                for (int x = 0; x < board; ++x) {
                    double sum = node.weights.size() > 1 ? weight(node, 1, o) : 0;
                    for (int i = 0; i < ins; ++i)
                        for (int ky = 0; ky < side; ++ky)
                            for (int kx = 0; kx < side; ++kx) {
                                const int sy = y + ky - side / 2, sx = x + kx - side / 2;
                                if (sy < 0 || sx < 0 || sy >= board || sx >= board) continue;
                                sum += weight(node, 0, ((o * ins + i) * side + ky) * side + kx) *
                                       input(node, 0)[at((i * board + sy) * board + sx)];
                            }
                    out.push_back(sum);
                }
        return out;
    }

    Values dense(const Node& node) const {
        const int outs = node.weights[0].shape[0], ins = node.weights[0].shape[1];
        Values out;
        for (int o = 0; o < outs; ++o) {
            double sum = node.weights.size() > 1 ? weight(node, 1, o) : 0;
            for (int i = 0; i < ins; ++i)
                sum += weight(node, 0, o * ins + i) * input(node, 0)[at(i)];
            out.push_back(sum);
        }
        return out;
    }

    Values pool(const Node& node, int channels) const {
        Values mean, scaled, third;
        const double d = board - 14;
        for (int c = 0; c < channels; ++c) {
            double sum = 0, most = -1e30;
            for (int p = 0; p < points(); ++p) {
                sum += input(node, 0)[at(c * points() + p)];
                most = std::max(most, input(node, 0)[at(c * points() + p)]);
            }
            mean.push_back(sum / points());
            scaled.push_back(mean.back() * d / 10);
            third.push_back(
                node.pooling == Pooling::mean_maximum ? most : mean.back() * (d * d / 100 - 0.1));
        }
        if (node.pooling == Pooling::mean) return mean;
        mean.insert(mean.end(), scaled.begin(), scaled.end());
        mean.insert(mean.end(), third.begin(), third.end());
        return mean;
    }

    double elementwise(const Node& node, int i, int c, int channels) const {
        const double x = input(node, 0)[at(i)];
        switch (node.operation) {
            case Operation::batch_norm:
                return (x - weight(node, 0, c)) / std::sqrt(weight(node, 1, c) + node.epsilon) *
                           weight(node, 2, c) +
                       weight(node, 3, c);
            case Operation::affine:
                return x * weight(node, 0, c) + weight(node, 1, c);
            case Operation::add:
                return x + input(node, 1)[at(i)];
            case Operation::add_vector:
                return x + input(node, 1)[at(c)];
            case Operation::squeeze_scale:
                return x / (1 + std::exp(-input(node, 1)[at(c)])) +
                       input(node, 1)[at(c + channels)];
            case Operation::point_bias:
                return x + weight(node, 0, i);
            default:
                return x;
        }
    }

    Values compute(const Node& node, Shape shape) const {
        if (node.operation == Operation::convolution) return convolution(node);
        if (node.operation == Operation::dense) return dense(node);
        if (node.operation == Operation::pool)
            return pool(node, shape.channels / (node.pooling == Pooling::mean ? 1 : 3));
        if (node.operation == Operation::flatten) return input(node, 0);
        Values out;
        if (node.operation == Operation::concatenate) {
            for (const int part : node.inputs)
                out.insert(out.end(), results[at(part)].begin(), results[at(part)].end());
            return out;
        }
        if (node.operation == Operation::gather) {
            for (const int index : node.table) out.push_back(input(node, 0)[at(index)]);
            return out;
        }
        for (int i = 0; i < static_cast<int>(shape.size(points())); ++i)
            out.push_back(
                elementwise(node, i, shape.over_board ? i / points() : i, shape.channels));
        return out;
    }

    // Inputs by name, for one position.
    void run(const std::map<std::string, Values>& inputs) {
        for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
            const auto& node = graph.nodes[n];
            results[n] = node.operation == Operation::input ? inputs.at(node.name)
                                                            : compute(node, shapes[n]);
            const bool layer =
                node.operation == Operation::convolution || node.operation == Operation::dense;
            const int own = node.operation == Operation::squeeze_scale ? 2 : 1;
            if ((layer || own == 2) && static_cast<int>(node.inputs.size()) > own)
                for (std::size_t i = 0; i < results[n].size(); ++i)
                    results[n][i] += input(node, own)[i];
            for (auto& x : results[n]) x = activate(node.activation, static_cast<float>(x));
        }
    }
};

inline float uniform(engine::Random& random) {
    return static_cast<float>(random.below(20001) - 10000) / 10000;
}

inline Tensor random_tensor(engine::Random& random, std::vector<int> shape, float scale = 1,
                            float shift = 0) {
    std::size_t count = 1;
    for (const int side : shape) count *= at(side);
    Tensor tensor{std::move(shape), std::vector<float>(count)};
    for (auto& value : tensor.values) value = uniform(random) * scale + shift;
    return tensor;
}

// What `executor` answers for random positions, beside what the loops answer; the largest
// difference of any number in any output.
inline double worst_difference(const Graph& graph, Executor& executor, int board, int size,
                               engine::Random& random) {
    const auto shapes = infer_shapes(graph, board);
    std::vector<std::vector<float>> inputs, outputs;
    for (const int n : graph.input_nodes())
        inputs.push_back(
            random_tensor(random, {size, static_cast<int>(shapes[at(n)].size(board * board))})
                .values);
    for (const auto& output : graph.outputs)
        outputs.emplace_back(shapes[at(output.node)].size(board * board) * at(size));
    const std::vector<std::span<const float>> in(inputs.begin(), inputs.end());
    const std::vector<std::span<float>> out(outputs.begin(), outputs.end());
    executor.run({size, board, in, out});

    double worst = 0;
    for (int position = 0; position < size; ++position) {
        Machine machine{graph, board};
        std::map<std::string, Values> named;
        std::size_t next = 0;
        for (const int n : graph.input_nodes()) {
            const auto count = shapes[at(n)].size(board * board);
            const auto* from = inputs[next++].data() + count * at(position);
            named[graph.nodes[at(n)].name] = Values(from, from + count);
        }
        machine.run(named);
        for (std::size_t o = 0; o < outputs.size(); ++o) {
            const auto& expected = machine.results[at(graph.outputs[o].node)];
            for (std::size_t i = 0; i < expected.size(); ++i) {
                const double found = outputs[o][expected.size() * at(position) + i];
                worst = std::max(worst, std::isfinite(found) ? std::abs(found - expected[i]) : 1e9);
            }
        }
    }
    return worst;
}

// A network that holds every operation, each result read by a later one or an output.
inline Graph every_operation(engine::Random& random, int board, int channels = 5) {
    const auto tensor = [&](std::vector<int> shape) {
        return random_tensor(random, std::move(shape), 0.5f);
    };
    const int c = channels;
    Graph g;
    g.facts.board = board;
    const int planes = add_input(g, "planes", {3, true});
    const int globals = add_input(g, "globals", {4, false});
    int x = add_convolution(g, "first", planes, {tensor({c, 3, 5, 5})});
    const int side = add_dense(g, "globals.dense", globals, {tensor({c, 4}), tensor({c})});
    x = add_operation(g, Operation::add_vector, "x0", {x, side});
    int u = add_batch_norm(
        g, "norm", x, {tensor({c}), random_tensor(random, {c}, 0.4f, 1), tensor({c}), tensor({c})},
        0.01f);
    u = add_activation(g, "mish", u, Activation::mish);
    u = add_convolution(g, "second", u, {tensor({c, c, 3, 3}), tensor({c})});
    u = add_batch_norm(g, "norm2", u,
                       {tensor({c}), random_tensor(random, {c}, 0.4f, 1), tensor({c}), tensor({c})},
                       0.01f);
    x = add_operation(g, Operation::add, "x1", {x, u});
    x = add_activation(g, "relu", x, Activation::relu);
    const int pooled = add_pool(g, "mean", x, Pooling::mean);
    const int z = add_dense(g, "excite", pooled, {tensor({2 * c, c}), tensor({2 * c})});
    u = add_convolution(g, "third", x, {tensor({c, c, 3, 3}), tensor({c})});
    u = add_operation(g, Operation::squeeze_scale, "squeeze", {u, z});
    x = add_operation(g, Operation::add, "x2", {u, x});
    x = add_activation(g, "silu", x, Activation::silu);
    x = add_operation(g, Operation::affine, "affine", {x}, {tensor({c}), tensor({c})});
    int p = add_convolution(g, "policy.planes", x, {tensor({2, c, 1, 1})});
    p = add_operation(g, Operation::point_bias, "policy.points", {p}, {tensor({2, board * board})});
    p = add_operation(g, Operation::flatten, "policy.flat", {p});
    const int peak = add_pool(g, "maximum", x, Pooling::mean_maximum);
    const int pass = add_dense(g, "pass", peak, {tensor({1, 3 * c})});
    p = add_operation(g, Operation::concatenate, "policy.all", {p, pass});
    p = add_gather(g, "policy", p, {2 * board * board, 3, 1, 0, 7});
    int v = add_pool(g, "quadratic", x, Pooling::mean_quadratic);
    v = add_dense(g, "value.hidden", v, {tensor({6, 3 * c}), tensor({6})});
    v = add_activation(g, "value.plus", v, Activation::softplus);
    v = add_dense(g, "value.last", v, {tensor({1, 6}), tensor({1})});
    v = add_activation(g, "value", v, Activation::tanh);
    name_output(g, "policy", p);
    name_output(g, "value", v);
    name_output(g, "body", x);
    return g;
}

}  // namespace nn::naive
