// What the oneDNN executor does between layers, over rows of channels (a point's numbers lie side
// by side): conversions, scales, sums, activations, pooling, small layers. The same loops are
// compiled for three instruction sets; kernels() picks by what the processor has.
#pragma once

#include <cstddef>

#include "nn/graph.h"

namespace nn::onednn {

enum class Format : std::uint8_t { f32, bf16, u8, s8 };
constexpr std::size_t formats = 4;

// out = activation(in * scale + shift + residual) * post, for every point of every position.
// Null: no such factor or term. `step` is the distance of the scales and shifts of two positions.
// `exact`, where there is one, gets the same in f32 and without `post`.
struct Transform {
    const float* in = nullptr;
    const float* residual = nullptr;
    const float* scale = nullptr;
    const float* shift = nullptr;
    const float* post = nullptr;
    std::ptrdiff_t step = 0;
    Activation activation = Activation::identity;
    void* out = nullptr;
    Format format = Format::f32;
    float* exact = nullptr;
    int positions = 0, points = 0, channels = 0;
};

struct Pool {
    const float* in = nullptr;
    float* out = nullptr;
    Pooling pooling = Pooling::mean;
    int positions = 0, points = 0, channels = 0;
    float side = 0;  // of the board
};

// Between channel after channel (`planes`) and rows of channels.
struct Turn {
    const float* in = nullptr;
    void* out = nullptr;
    Format format = Format::f32;
    const float* post = nullptr;
    int positions = 0, points = 0, channels = 0;
};

// A small layer on `rows` vectors: out = activation(weights in + bias + residual). The weights are
// packed by pack_small.
struct Small {
    const float* in = nullptr;
    const float* weights = nullptr;
    const float* bias = nullptr;
    const float* residual = nullptr;
    float* out = nullptr;
    Activation activation = Activation::identity;
    int rows = 0, ins = 0, outs = 0;
};
constexpr int small_block = 32;

struct Kernels {
    void (*transform)(const Transform&);
    void (*pool)(const Pool&);
    void (*to_rows)(const Turn&);
    void (*to_planes)(const Turn&);  // writes f32
    void (*small)(const Small&);
};

const Kernels& kernels();
const Kernels& baseline_kernels();
const Kernels& avx2_kernels();
const Kernels& avx512_kernels();

}  // namespace nn::onednn
