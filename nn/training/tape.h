// What one pass through a graph leaves behind for the way back: the value of every node for a whole
// batch, the gradient of the loss by it, and whatever an operation keeps. Plain layout: sample
// after sample, channel after channel, row after row. Operations read the values of their inputs
// and write their own; on the way back they read their own gradient and add to those of their
// inputs and weights. A tape belongs to one thread.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "nn/graph.h"
#include "nn/index.h"
#include "nn/training/parameters.h"

namespace nn::training {

using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Rows = Eigen::Map<Matrix>;
using ConstRows = Eigen::Map<const Matrix>;

struct Tape {
    Tape(const Graph& unfused, const Parameters& layout, int batch, int side);

    const Graph& graph;
    const Parameters& parameters;
    int size, board;       // samples, side
    bool learning = true;  // batch norms use the batch's statistics, else their running ones
    std::vector<Shape> shapes;
    std::vector<std::vector<float>> values, gradients, kept;  // per node
    std::span<const float> weights;     // of all nodes, as `parameters` lays them out
    std::span<float> weight_gradients;  // alike. A batch norm's statistics get the sums over
                                        // samples of the batch's mean and mean square

    const Node& node(int n) const { return graph.nodes[at(n)]; }
    int input(int n, int i) const { return node(n).inputs[at(i)]; }
    int channels(int n) const { return shapes[at(n)].channels; }
    int points(int n) const { return shapes[at(n)].over_board ? board * board : 1; }
    std::size_t count(int n) const { return shapes[at(n)].size(board * board) * at(size); }
    bool wants_gradient(int n) const { return node(n).operation != Operation::input; }

    // Gives a node room for its value and, if it wants one, its gradient.
    void reserve(int n);

    // One row a sample.
    Rows samples(int n) { return all_of(values, n); }
    Rows sample_gradients(int n) { return all_of(gradients, n); }
    // One sample: a row a channel.
    Rows sample(int n, int i) { return sample_of(values, n, i); }
    Rows sample_gradient(int n, int i) { return sample_of(gradients, n, i); }

    // A weight as a matrix of as many rows as its first side has.
    ConstRows weight(int n, int w) const;
    Rows weight_gradient(int n, int w) const;

    // visit(i) for every sample.
    template <class Visit>
    void for_samples(Visit visit) const {
        for (int i = 0; i < size; ++i) visit(i);
    }

   private:
    Rows all_of(std::vector<std::vector<float>>& store, int n) {
        return {store[at(n)].data(), size, Eigen::Index{channels(n)} * points(n)};
    }
    Rows sample_of(std::vector<std::vector<float>>& store, int n, int i) {
        return {store[at(n)].data() + at(i) * shapes[at(n)].size(board * board), channels(n),
                points(n)};
    }
};

}  // namespace nn::training
