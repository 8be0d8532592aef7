// The inner loops as a table of functions over plain arrays, one table an instruction set. Each
// job describes one call; nothing here owns memory or checks its arguments. The table of a set may
// be used only where the processor has it: see best_kernels. No standard library code is included,
// lest a copy compiled for a newer processor be the one that the linker keeps for all.
#pragma once

#include <cstddef>
#include <cstdint>

namespace nn::winograd {

// Channels are kept in vectors of this many, whatever the instruction set.
constexpr int lanes = 16;
// Most vectors of output channels that one call of `multiply` makes.
constexpr int most_width = 4;

enum class Curve : std::uint8_t { identity, relu, mish, silu, tanh, sigmoid, square_root };

// Boards of floats lie point after point, channels innermost. Boards of words (int16) lie the same
// way within a border of zeros, `padded` points a side, so that tiles need no special cases.
struct Geometry {
    int side = 0, padded = 0;
    int tile = 0;   // outputs a side of a tile
    int tiles = 0;  // tiles a side of the board
};

// What becomes of a value v before it is stored:
//   v = first(v + bias + residual), kept in floats if wanted;
//   w = second(v · scale + shift) / step, rounded and clipped, kept in words if wanted.
// When `second` is identity or relu the division is part of scale and shift.
struct Finish {
    Geometry board;
    int channels = 0;  // stride of a point of floats
    int word_channels = 0;
    const float* bias = nullptr;
    std::ptrdiff_t bias_stride = 0;  // per position; 0: one bias for all
    const float* residual = nullptr;
    std::ptrdiff_t residual_stride = 0;  // per position
    Curve first = Curve::identity, second = Curve::identity;
    float* floats = nullptr;
    const float* scale = nullptr;
    const float* shift = nullptr;
    const float* inverse_step = nullptr;
    float lowest = 0, highest = 0;
    std::int16_t* words = nullptr;
};

// Words to the tiles' transforms: out[cell][tile][channel].
struct TransformJob {
    Geometry board;
    int positions = 0, channels = 0;
    const std::int16_t* words = nullptr;
    std::int16_t* out = nullptr;
    std::ptrdiff_t cell_stride = 0;
};

// For every cell a matrix product of int16 summed in int32, then scaled to float:
// out[row][cell][width · lanes]. Weights [cell][pair][width · lanes][2].
struct MultiplyJob {
    const std::int16_t* inputs = nullptr;
    std::ptrdiff_t cell_stride = 0, row_stride = 0;
    int cells = 0, rows = 0, pairs = 0, width = 0;
    const std::int16_t* weights = nullptr;
    const float* scale = nullptr;  // [cell][width · lanes]
    float* out = nullptr;
};

// Products of all cells back to points.
struct FinishJob {
    int positions = 0;
    int width = 0, channel = 0;  // of this group of output channels
    const float* products = nullptr;
};

// A 1x1 convolution straight from words.
struct PointsJob {
    int positions = 0, pairs = 0, width = 0, channel = 0;
    int word_channels = 0;  // stride of a point of what it reads
    const std::int16_t* words = nullptr;
    const std::int16_t* weights = nullptr;
    const float* scale = nullptr;
};

// One number that is not zero among the input planes.
struct Entry {
    float value;
    std::int32_t offset;  // (column · planes + plane) · channels
};

// A first convolution, summed over the entries alone: `starts` holds for every point where its
// entries begin. Weights [ky][kx][plane][channel]. `borders` is what planes that are the same all
// over the board add, by how the kernel is cut at the borders: [2 r + 1][2 r + 1][channel].
struct FirstJob {
    int position = 0, kernel = 0, planes = 0;
    const Entry* entries = nullptr;
    const std::int32_t* starts = nullptr;
    const float* weights = nullptr;
    const float* borders = nullptr;
};

// v = source · scale at every point.
struct PointwiseJob {
    int positions = 0;
    const float* source = nullptr;
    const float* scale = nullptr;
    std::ptrdiff_t scale_stride = 0;
};

// Means and maxima over the points of one position.
struct PoolJob {
    int points = 0, channels = 0;
    const float* source = nullptr;
    float* mean = nullptr;
    float* maximum = nullptr;
};

// out = weights · input + bias for some positions; weights [input][outputs], outputs a multiple of
// lanes.
struct DenseJob {
    int positions = 0, inputs = 0, outputs = 0;
    const float* weights = nullptr;
    const float* bias = nullptr;
    const float* input = nullptr;
    std::ptrdiff_t input_stride = 0;
    float* out = nullptr;
    std::ptrdiff_t out_stride = 0;
};

struct Kernels {
    const char* name;
    int width;  // vectors of output channels that `multiply` does best, at most
    void (*transform)(const TransformJob&);
    void (*multiply)(const MultiplyJob&);
    void (*finish)(const FinishJob&, const Finish&);
    void (*points)(const PointsJob&, const Finish&);
    void (*first)(const FirstJob&, const Finish&);
    void (*pointwise)(const PointwiseJob&, const Finish&);
    void (*pool)(const PoolJob&);
    void (*dense)(const DenseJob&);
    void (*activate)(Curve, float* values, int count);  // count a multiple of lanes
    // Bit i of the result: whether values[i] is not zero, i under 64; reads no further than count.
    std::uint64_t (*nonzero)(const float* values, int count);
    // Multiply-adds from registers only: the peak that shares are quoted of. Yields their number.
    std::int64_t (*peak)(std::int64_t rounds);
};

const Kernels* avx512_kernels();
const Kernels* avx2_kernels();
// The fastest set that this processor has, or null.
const Kernels* best_kernels();

}  // namespace nn::winograd
