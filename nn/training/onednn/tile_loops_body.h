// The loops of tiled.h, over vectors of Build::Vector, Build::most rows of a block's width held in
// registers at once. Only for the files that compile them: each passes a type of its own as Build,
// so that code for one instruction set never stands in for another's; and no library code is
// included.
#pragma once

#include "nn/training/onednn/tiled.h"

namespace nn::training {

template <class Build>
struct TileLoopsBody {
    using Index = std::ptrdiff_t;
    using Vector = typename Build::Vector;
    static constexpr Index bytes = sizeof(Vector), width = bytes / Index{sizeof(float)};
    static constexpr Index vectors = lanes / width, most = Build::most;

    // `rows` rows of a block.
    template <Index rows>
    struct Tile {
        Vector row[rows][vectors];

        void load(const float* from, Index stride) {
            for (Index r = 0; r < rows; ++r)
                for (Index v = 0; v < vectors; ++v)
                    __builtin_memcpy(&row[r][v], from + r * stride + v * width, bytes);
        }
        void store(float* to) const {
            for (Index r = 0; r < rows; ++r)
                for (Index v = 0; v < vectors; ++v)
                    __builtin_memcpy(to + r * lanes + v * width, &row[r][v], bytes);
        }
        // row r += factors[r * stride] times `other`.
        void add(const float* factors, Index stride, const float* other) {
            Vector b[vectors];
            for (Index v = 0; v < vectors; ++v) __builtin_memcpy(&b[v], other + v * width, bytes);
#pragma GCC unroll 8
            for (Index r = 0; r < rows; ++r) {
                const float a = factors[r * stride];
#pragma GCC unroll 4
                for (Index v = 0; v < vectors; ++v) row[r][v] += a * b[v];
            }
        }
    };

    // Calls visit.template operator()<rows>(first) for `count` rows in tiles as equal as can be.
    template <class Visit>
    static void for_tiles(Index count, Visit visit) {
        const Index tiles = (count + most - 1) / most;
        for (Index t = 0; t < tiles; ++t)
            call<most>(count * t / tiles, count * (t + 1) / tiles, visit);
    }
    template <Index rows, class Visit>
    static void call(Index first, Index last, Visit visit) {
        if (last - first == rows) return visit.template operator()<rows>(first);
        if constexpr (rows > 1) call<rows - 1>(first, last, visit);
    }

    // Some points of a row, all inputs of one block.
    template <Index points>
    static void add_points(const TileShape& shape, const float* x, const float* kernel,
                           const float* start, Index start_stride, float* y) {
        Tile<points> tile;
        tile.load(start, start_stride);
        for (Index row = 0; row < shape.side; ++row)
            for (Index column = 0; column < shape.side; ++column) {
                const float* const from = x + (row * shape.framed() + column) * lanes;
                for (Index lane = 0; lane < lanes; ++lane, kernel += lanes)
                    tile.add(from + lane, lanes, kernel);
            }
        tile.store(y);
    }

    // One block of inputs after the other, so that its part of the kernel stays in the first cache.
    static void convolve(const TileShape& shape, const float* x, const float* kernel,
                         const float* bias, float* y) {
        const Index framed = shape.framed();
        for (Index out = 0; out < shape.out; ++out)
            for (Index in = 0; in < shape.in; ++in) {
                const float* const part =
                    kernel + (out * shape.in + in) * shape.places() * lanes * lanes;
                for (Index row = 0; row < shape.board; ++row)
                    for_tiles(shape.board, [&]<Index points>(Index column) {
                        float* const to =
                            y + ((out * shape.board + row) * shape.board + column) * lanes;
                        const bool first = in == 0;
                        add_points<points>(
                            shape, x + ((in * framed + row) * framed + column) * lanes, part,
                            first ? bias + out * lanes : to, first ? 0 : lanes, to);
                    });
            }
    }

    template <Index inputs>
    static void add_inputs(const TileShape& shape, const float* x, const float* y, float* sums) {
        Tile<inputs> tile;
        tile.load(sums, lanes);
        for (Index row = 0; row < shape.board; ++row) {
            const float* from = x + row * shape.framed() * lanes;
            const float* const end = y + shape.board * lanes;
            for (; y < end; y += lanes, from += lanes) tile.add(from, 1, y);
        }
        tile.store(sums);
    }

    static void add_products(const TileShape& shape, const float* x, const float* y, float* sums) {
        const Index framed = shape.framed();
        for (Index out = 0; out < shape.out; ++out)
            for (Index in = 0; in < shape.in; ++in)
                for (Index place = 0; place < shape.places(); ++place, sums += lanes * lanes) {
                    const Index row = place / shape.side, column = place % shape.side;
                    const float* const from = x + ((in * framed + row) * framed + column) * lanes;
                    for_tiles(lanes, [&]<Index inputs>(Index lane) {
                        add_inputs<inputs>(shape, from + lane, y + out * shape.points() * lanes,
                                           sums + lane * lanes);
                    });
                }
    }

    static constexpr TileLoops table() { return {convolve, add_products}; }
};

}  // namespace nn::training
