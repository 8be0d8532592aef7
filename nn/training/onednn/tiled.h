// A convolution in fp32 by our own loops, forward and backward, over values in blocks (blocked.h):
// for processors without AVX-512, where oneDNN has nothing but slow reference code for that layout
// and, in its own, half of the rate. For one batch size and board.
#pragma once

#include <vector>

#include "nn/training/onednn/blocked.h"

namespace nn::training {

// Of one sample: x [in][points][lanes], y [out][points][lanes].
struct TileShape {
    std::ptrdiff_t in, out;  // blocks
    std::ptrdiff_t side;     // of the kernel, odd
    std::ptrdiff_t board;
    std::ptrdiff_t places() const { return side * side; }
    std::ptrdiff_t points() const { return board * board; }
    // The board in a border of zeros, as the loops read x: [in][framed][framed][lanes].
    std::ptrdiff_t framed() const { return board + side - 1; }
    TileShape turned() const { return {out, in, side, board}; }
};

struct TileLoops {
    // Kernel [out][in][places][input lane][output lane], bias [out][lanes].
    void (*convolve)(const TileShape& shape, const float* framed_x, const float* kernel,
                     const float* bias, float* y);
    // Adds to the kernel's gradient, laid out like the kernel.
    void (*add_products)(const TileShape& shape, const float* framed_x, const float* y_gradient,
                         float* sums);
};
// For any processor, and for those with AVX2 and FMA, to be called only there.
extern const TileLoops portable_tile_loops, avx2_tile_loops;
// The best for this processor.
const TileLoops& tile_loops();

class TiledConvolution {
   public:
    // `side` of the kernel, odd.
    TiledConvolution(Extent x, Extent y, int side, int board,
                     const TileLoops& loops = tile_loops());

    // Kernel [out, in, side, side], bias [out] or null.
    void load(const float* kernel, const float* bias);
    void forward(const float* x, float* y);
    // Overwrites the gradient by x.
    void backward_data(const float* y_gradient, float* x_gradient);
    // Adds to the gradient of the kernel.
    void backward_weights(const float* x, const float* y_gradient);
    // Adds what backward_weights has summed to `kernel` and starts again.
    void collect(float* kernel);

   private:
    const float* frame(const float* sample, std::ptrdiff_t blocks);

    const TileLoops& loops_;
    Extent x_, y_;
    TileShape shape_;
    std::vector<float> kernel_, turned_kernel_, bias_, no_bias_, frame_;
    std::vector<float> sums_;  // laid out like kernel_
};

}  // namespace nn::training
