// How the operations of a graph are grouped into steps, and in which forms their results are kept.
#pragma once

#include <vector>

#include "nn/graph.h"

namespace nn::winograd {

enum class Form : std::uint8_t { floats, words, vector };

// Per node.
struct Role {
    bool floats = false, words = false;  // the forms of a board that somebody reads
    bool hidden = false;                 // computed within another node's step, or an input board
    int carrier = -1;  // of an add_vector: the convolution that adds the vector as its bias
    int affine = -1;   // the affine node that the step applies on the way to words
    bool wide = true;  // only 1x1 convolutions read the words: they may use more of int16
};

enum class Kind : std::uint8_t { first, tower, points, pointwise, pool, dense, numbers };

// What computes a node; of a carried convolution, that of the add_vector.
Kind kind_of(const Graph& graph, const std::vector<Shape>& shapes, int node);

std::vector<Role> assign_roles(const Graph& graph, const std::vector<Shape>& shapes);

}  // namespace nn::winograd
