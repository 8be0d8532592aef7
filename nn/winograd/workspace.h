// What one executor computes in: buffers by number, allocated once. Steps read and write them; a
// workspace belongs to one thread at a time.
#pragma once

#include <span>
#include <vector>

#include "nn/winograd/buffer.h"
#include "nn/winograd/kernels.h"

namespace nn::winograd {

// Sizes for one position, in numbers.
struct Layout {
    Geometry board;
    int positions = 0;  // most that are computed together
    std::vector<std::size_t> floats, words, vectors;
    std::size_t transformed = 0, products = 0;
    std::size_t entries = 0;   // most nonzero numbers among the planes
    std::size_t channels = 0;  // of the widest tensor

    int points() const { return board.side * board.side; }
};

struct Workspace {
    Workspace(const Kernels& set, const Layout& plan);

    const Kernels& kernels;
    const Layout& layout;
    int positions = 0;  // of this run
    // The inputs of the network for these positions, in the order of Graph::input_nodes.
    std::vector<const float*> inputs;

    std::vector<Buffer<float>> floats, vectors;  // over the board; not
    std::vector<Buffer<std::int16_t>> words;
    Buffer<std::int16_t> transformed;
    Buffer<float> products, biases, scales, borders, pooled;
    std::vector<Entry> entries;
    std::vector<std::int32_t> starts, counts;
    std::vector<std::uint64_t> bits;

    // Numbers a position takes in a vector's buffer.
    std::ptrdiff_t vector_stride(int vector) const {
        return static_cast<std::ptrdiff_t>(layout.vectors[static_cast<std::size_t>(vector)]);
    }
    float* vector(int index, int position = 0) const {
        return vectors[static_cast<std::size_t>(index)].data() + position * vector_stride(index);
    }
    float* board(int index) const { return floats[static_cast<std::size_t>(index)].data(); }
    std::int16_t* board_of_words(int index) const {
        return words[static_cast<std::size_t>(index)].data();
    }
};

}  // namespace nn::winograd
