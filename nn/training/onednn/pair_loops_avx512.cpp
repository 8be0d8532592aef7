// Compiled for AVX-512 with bf16, and free of library code that another file might share.
#include <immintrin.h>

#include "nn/training/onednn/paired_gradient.h"

namespace nn::training {

namespace {

using Index = std::ptrdiff_t;

__m512i widened(const Bf16* from) {
    return _mm512_cvtepu16_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)));
}

void interleave(Index blocks, Index points, const Bf16* a, const Bf16* b, std::uint32_t* pairs) {
    for (Index block = 0; block < blocks; ++block)
        for (Index p = 0; p < points; ++p) {
            const Index from = (block * points + p) * lanes;
            __m512i pair = widened(a + from);
            if (b) pair = _mm512_or_si512(pair, _mm512_slli_epi32(widened(b + from), 16));
            _mm512_storeu_si512(pairs + (p * blocks + block) * lanes, pair);
        }
}

// One place in the kernel: which outputs it serves, and where their inputs are.
struct Place {
    Index top, bottom, left, right;  // of outputs
    Index shift;                     // in points

    Place(const PairShape& shape, Index row, Index column) {
        const Index dy = row - shape.side / 2, dx = column - shape.side / 2;
        top = dy < 0 ? -dy : 0;
        bottom = shape.board - (dy > 0 ? dy : 0);
        left = dx < 0 ? -dx : 0;
        right = shape.board - (dx > 0 ? dx : 0);
        shift = dy * shape.board + dx;
    }
};

// The sums of `rows` input channels by `vectors` blocks of output channels, held in registers.
template <int rows, int vectors>
struct Tile {
    __m512 sum[rows][vectors];

    void load(const float* sums, Index stride) {
        for (Index r = 0; r < rows; ++r)
            for (Index v = 0; v < vectors; ++v)
                sum[r][v] = _mm512_loadu_ps(sums + r * stride + v * lanes);
    }
    void store(float* sums, Index stride) const {
        for (Index r = 0; r < rows; ++r)
            for (Index v = 0; v < vectors; ++v)
                _mm512_storeu_ps(sums + r * stride + v * lanes, sum[r][v]);
    }
    void add_point(const std::uint32_t* x, const std::uint32_t* y) {
        __m512bh gradient[vectors];
        for (Index v = 0; v < vectors; ++v)
            gradient[v] = reinterpret_cast<__m512bh>(_mm512_loadu_si512(y + v * lanes));
#pragma GCC unroll 16
        for (Index r = 0; r < rows; ++r) {
            const auto value =
                reinterpret_cast<__m512bh>(_mm512_set1_epi32(static_cast<int>(x[r])));
            for (Index v = 0; v < vectors; ++v)
                sum[r][v] = _mm512_dpbf16_ps(sum[r][v], value, gradient[v]);
        }
    }
};

template <int rows, int vectors>
void add_tile(const PairShape& shape, const Place& place, Index count, const std::uint32_t* x,
              const std::uint32_t* y, float* sums) {
    Tile<rows, vectors> tile;
    tile.load(sums, shape.out);
    for (Index pair = 0; pair < count; ++pair)
        for (Index row = place.top; row < place.bottom; ++row) {
            const Index first = pair * shape.points() + row * shape.board;
            for (Index p = first + place.left; p < first + place.right; ++p)
                tile.add_point(x + (p + place.shift) * shape.in, y + p * shape.out);
        }
    tile.store(sums, shape.out);
}

// All input channels by some output channels.
template <int rows, int vectors>
void add_strip(const PairShape& shape, Index count, const std::uint32_t* x, const std::uint32_t* y,
               float* sums) {
    for (Index in = 0; in < shape.in; in += rows)
        for (Index k = 0; k < shape.side * shape.side; ++k) {
            const Place place(shape, k / shape.side, k % shape.side);
            if (place.top >= place.bottom || place.left >= place.right) continue;
            add_tile<rows, vectors>(shape, place, count, x + in, y,
                                    sums + (k * shape.in + in) * shape.out);
        }
}

void add_products(const PairShape& shape, Index count, const std::uint32_t* x,
                  const std::uint32_t* y, float* sums) {
    for (Index out = 0; out < shape.out;) {
        const Index blocks = (shape.out - out) / lanes;
        // Six blocks go as three and three.
        const Index taken = blocks == 6 ? 3 : blocks > 4 ? 4 : blocks;
        if (taken == 4) add_strip<4, 4>(shape, count, x, y + out, sums + out);
        if (taken == 3) add_strip<8, 3>(shape, count, x, y + out, sums + out);
        if (taken == 2) add_strip<8, 2>(shape, count, x, y + out, sums + out);
        if (taken == 1) add_strip<16, 1>(shape, count, x, y + out, sums + out);
        out += taken * lanes;
    }
}

}  // namespace

const PairLoops& pair_loops() {
    static constexpr PairLoops loops = {interleave, add_products};
    return loops;
}

}  // namespace nn::training
