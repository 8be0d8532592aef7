// Weights in the order in which the kernels read them.
#pragma once

#include <vector>

#include "nn/graph.h"
#include "nn/winograd/buffer.h"
#include "nn/winograd/kernels.h"
#include "nn/winograd/tiling.h"

namespace nn::winograd {

constexpr int padded(int channels, int to = lanes) { return (channels + to - 1) / to * to; }

// How a tensor is written as int16: value = word · step of its channel, -low <= word <= high.
struct Quantisation {
    std::vector<float> steps;  // per channel
    int low = 0, high = 0;
};

// Output channels that are computed together.
struct Group {
    int width = 0, channel = 0;  // vectors; first channel
    Buffer<std::int16_t> weights;
    Buffer<float> scale;
};

// Splits vectors of channels into groups of at most `most`, none of them narrow if it can be
// helped.
std::vector<int> split_widths(int vectors, int most);

// A 3x3 convolution by `tiling`, or a 1x1 convolution when that is null. Every (cell, output
// channel) has a scale of its own, as small as int16 weights and a sum in 32 bits allow.
std::vector<Group> pack_convolution(const Tensor& kernel, const Quantisation& input,
                                    const Tiling* tiling, int widest);

// [ky][kx][plane][channel]
Buffer<float> pack_first(const Tensor& kernel);
// What a plane of ones adds, by how the kernel is cut: [plane][2 r + 1][2 r + 1][channel].
Buffer<float> pack_borders(const Tensor& kernel);

// [input][outputs padded]
Buffer<float> pack_dense(const Tensor& weights);

// `values`, then `filler` up to a multiple of lanes.
Buffer<float> pack_vector(const std::vector<float>& values, float filler = 0);

}  // namespace nn::winograd
