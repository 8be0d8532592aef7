// The gradient of a convolution's kernel from bf16, at the full rate of vdpbf16ps: the instruction
// multiplies pairs and adds them up, and here a pair is one point of two samples, so that neither
// layout nor border needs care. (oneDNN 2.6 reaches half of that.) For one batch size and board.
#pragma once

#include <vector>

#include "nn/training/onednn/blocked.h"

namespace nn::training {

struct PairShape {
    std::ptrdiff_t in, out;  // channels, filled up to whole blocks
    std::ptrdiff_t side;     // of the kernel
    std::ptrdiff_t board;
    std::ptrdiff_t points() const { return board * board; }
};

// Compiled for AVX-512 with bf16; only to be called where onednn::has_bf16().
struct PairLoops {
    // Point after point, channel after channel: `a` in the lower half, `b` (zeros if null) in the
    // upper.
    void (*interleave)(std::ptrdiff_t blocks, std::ptrdiff_t points, const Bf16* a, const Bf16* b,
                       std::uint32_t* pairs);
    // Adds to sums [place in the kernel, in, out] the products of `count` pairs of samples.
    void (*add_products)(const PairShape& shape, std::ptrdiff_t count, const std::uint32_t* x,
                         const std::uint32_t* y_gradient, float* sums);
};
const PairLoops& pair_loops();

class PairedGradient {
   public:
    PairedGradient(Extent x, Extent y, int side, int board);

    void add(const Bf16* x, const Bf16* y_gradient);
    // Adds what is summed to `kernel` [out, in, side, side] and starts again from zero.
    void collect(float* kernel);

   private:
    static constexpr std::ptrdiff_t most_pairs = 4;  // at a time, to stay in the cache

    Extent x_, y_;
    PairShape shape_;
    std::vector<std::uint32_t> x_pairs_, y_pairs_;
    std::vector<float> sums_;
};

}  // namespace nn::training
