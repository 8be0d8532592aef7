// The 3x3 and 1x1 convolutions for any instruction set `Isa`. For the kernels; no standard library
// code.
#pragma once

#include "nn/winograd/finisher.h"
#include "nn/winograd/transforms.h"

namespace nn::winograd {

// B^T d B of one tile and one vector of word channels: down the columns, then along the rows.
template <class Isa, int tile>
[[gnu::always_inline]] inline void transform_tile(const std::int16_t* from, std::ptrdiff_t row,
                                                  std::ptrdiff_t point, std::int16_t* to,
                                                  std::ptrdiff_t cell_stride) {
    using Words = typename Isa::Words;
    constexpr int side = tile + 2;
    Words half[side * side];
    repeat<side>([&](auto x) __attribute__((always_inline)) {
        Words d[side], t[side];
        repeat<side>([&](auto y) __attribute__((always_inline)) {
            d[y] = Isa::load_words(from + y * row + x * point);
        });
        Transform<tile>::input(d, t);
        repeat<side>([&](auto y) __attribute__((always_inline)) { half[y * side + x] = t[y]; });
    });
    repeat<side>([&](auto y) __attribute__((always_inline)) {
        Words t[side];
        Transform<tile>::input(half + y * side, t);
        repeat<side>([&](auto x) __attribute__((always_inline)) {
            Isa::store_words(to + (y * side + x) * cell_stride, t[x]);
        });
    });
}

template <class Isa, int tile>
void transform_board(const TransformJob& job) {
    const auto& board = job.board;
    const std::ptrdiff_t point = job.channels, row = board.padded * point;
    std::int16_t* out = job.out;
    for (int position = 0; position < job.positions; ++position)
        for (int y = 0; y < board.tiles; ++y)
            for (int x = 0; x < board.tiles; ++x, out += point) {
                const auto* from =
                    job.words + (position * board.padded + y * tile) * row + x * tile * point;
                for (int c = 0; c < job.channels; c += 2 * lanes)
                    transform_tile<Isa, tile>(from + c, row, point, out + c, job.cell_stride);
            }
}

template <class Isa>
void transform(const TransformJob& job) {
    if (job.board.tile == 4) return transform_board<Isa, 4>(job);
    if (job.board.tile == 3) return transform_board<Isa, 3>(job);
    transform_board<Isa, 2>(job);
}

struct Block {
    const std::int16_t* inputs;
    std::ptrdiff_t stride;
    const std::int16_t* weights;
    int pairs;
    const float* scale;
    float* out;
    std::ptrdiff_t out_stride;
};

// The heart of it all: rows x width vectors of sums stay in registers. Weights are read once for
// `rows` inputs, every input pair is broadcast once for `width` vectors.
template <class Isa, int width, int rows>
[[gnu::noinline]] void multiply_block(const Block& block) {
    typename Isa::Sums sums[rows][width];
    repeat<rows>([&](auto r) __attribute__((always_inline)) {
        repeat<width>([&](auto w) __attribute__((always_inline)) { sums[r][w] = Isa::zero(); });
    });
    const auto* weights = block.weights;
    const auto* inputs = block.inputs;
    const auto stride = block.stride;
    // The weights of the next cell, while this one's are used: they come from far.
    const std::ptrdiff_t ahead = std::ptrdiff_t{block.pairs} * 2 * lanes * width;
    for (int k = 0; k < block.pairs; ++k, weights += 2 * lanes * width, inputs += 2) {
        typename Isa::Pairs weight[width];
        repeat<width>([&](auto w) __attribute__((always_inline)) {
            weight[w] = Isa::load_pairs(weights + 2 * lanes * w);
            __builtin_prefetch(weights + ahead + 2 * lanes * w);
        });
        repeat<rows>([&](auto r) __attribute__((always_inline)) {
            const auto input = Isa::broadcast_pair(inputs + r * stride);
            repeat<width>([&](auto w) __attribute__((always_inline)) {
                Isa::multiply_add(sums[r][w], input, weight[w]);
            });
        });
    }
    repeat<width>([&](auto w) __attribute__((always_inline)) {
        const auto scale = Isa::load(block.scale + lanes * w);
        repeat<rows>([&](auto r) __attribute__((always_inline)) {
            Isa::store(block.out + r * block.out_stride + lanes * w,
                       Isa::to_floats(sums[r][w]) * scale);
        });
    });
}

template <class Isa, int width, int rows = Isa::most_rows(width)>
void multiply_rows(int count, const Block& block) {
    if (count == rows) return multiply_block<Isa, width, rows>(block);
    if constexpr (rows > 1) multiply_rows<Isa, width, rows - 1>(count, block);
}

// Splits the rows into blocks of almost the same size: a last block of one row would take as long
// as a full one.
template <class Isa, int width>
void multiply_cell(int rows, Block block) {
    constexpr int most = Isa::most_rows(width);
    int blocks = (rows + most - 1) / most;
    for (; blocks > 0; --blocks) {
        const int count = (rows + blocks - 1) / blocks;
        multiply_rows<Isa, width>(count, block);
        rows -= count;
        block.inputs += count * block.stride;
        block.out += count * block.out_stride;
    }
}

template <class Isa, int width = 1>
void multiply_width(int wanted, int rows, const Block& block) {
    if (wanted == width) return multiply_cell<Isa, width>(rows, block);
    if constexpr (width < most_width) multiply_width<Isa, width + 1>(wanted, rows, block);
}

template <class Isa>
void multiply(const MultiplyJob& job) {
    const std::ptrdiff_t vectors = job.width * lanes;
    for (int cell = 0; cell < job.cells; ++cell)
        multiply_width<Isa>(
            job.width, job.rows,
            {job.inputs + cell * job.cell_stride, job.row_stride,
             job.weights + cell * job.pairs * 2 * vectors, job.pairs, job.scale + cell * vectors,
             job.out + cell * vectors, job.cells * vectors});
}

struct Tile {
    int position, y, x;  // of its first point
};

// A^T p A of one tile and one vector of channels, finished.
template <class Isa, int tile, class Finisher>
[[gnu::always_inline]] inline void finish_tile(const float* products, std::ptrdiff_t cell_stride,
                                               const Finisher& finisher, Tile at, int channel) {
    using Floats = typename Isa::Floats;
    constexpr int side = tile + 2;
    Floats half[tile * side];
    repeat<side>([&](auto x) __attribute__((always_inline)) {
        Floats p[side], o[tile];
        repeat<side>([&](auto y) __attribute__((always_inline)) {
            p[y] = Isa::load(products + (y * side + x) * cell_stride);
        });
        Transform<tile>::output(p, o);
        repeat<tile>([&](auto y) __attribute__((always_inline)) { half[y * side + x] = o[y]; });
    });
    const int board = finisher.finish().board.side;
    repeat<tile>([&](auto y) __attribute__((always_inline)) {
        if (at.y + y >= board) return;
        Floats o[tile];
        Transform<tile>::output(half + y * side, o);
        repeat<tile>([&](auto x) __attribute__((always_inline)) {
            if (at.x + x < board) finisher.apply(o[x], at.position, at.y + y, at.x + x, channel);
        });
    });
}

template <class Isa, int tile, class Finisher>
void finish_board(const FinishJob& job, const Finisher& finisher) {
    constexpr int cells = (tile + 2) * (tile + 2);
    const std::ptrdiff_t vectors = job.width * lanes;
    const int tiles = finisher.finish().board.tiles;
    const float* products = job.products;
    for (int position = 0; position < job.positions; ++position)
        for (int y = 0; y < tiles; ++y)
            for (int x = 0; x < tiles; ++x, products += cells * vectors)
                for (int w = 0; w < job.width; ++w)
                    finish_tile<Isa, tile>(products + w * lanes, vectors, finisher,
                                           {position, y * tile, x * tile}, job.channel + w * lanes);
}

template <class Isa>
void finish(const FinishJob& job, const Finish& how) {
    with_finisher<Isa>(how, [&](const auto& finisher) {
        if (how.board.tile == 4) return finish_board<Isa, 4>(job, finisher);
        if (how.board.tile == 3) return finish_board<Isa, 3>(job, finisher);
        finish_board<Isa, 2>(job, finisher);
    });
}

// Row by row of the board: points of a row lie side by side among the words.
template <class Isa>
void points(const PointsJob& job, const Finish& how) {
    const auto& board = how.board;
    constexpr int most_side = 32;
    alignas(64) float products[most_side * most_width * lanes];
    const std::ptrdiff_t vectors = job.width * lanes, point = job.word_channels;
    with_finisher<Isa>(how, [&](const auto& finisher) {
        for (int position = 0; position < job.positions; ++position)
            for (int y = 0; y < board.side; ++y) {
                const auto row = (position * board.padded + y + 1) * board.padded + 1;
                multiply_width<Isa>(job.width, board.side,
                                    {job.words + row * point, point, job.weights, job.pairs,
                                     job.scale, products, vectors});
                for (int x = 0; x < board.side; ++x)
                    for (int w = 0; w < job.width; ++w)
                        finisher.apply(Isa::load(products + x * vectors + w * lanes), position, y,
                                       x, job.channel + w * lanes);
            }
    });
}

}  // namespace nn::winograd
