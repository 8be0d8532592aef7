#include "nn/training/onednn/tiled.h"

#include <algorithm>

#include "nn/index.h"
#include "nn/onednn/library.h"
#include "nn/training/onednn/tile_loops_body.h"

namespace nn::training {

namespace {

using Index = std::ptrdiff_t;

struct Portable {
    using Vector = float __attribute__((vector_size(16)));
    static constexpr int most = 3;
};

// In a kernel, of the number that channel `in` gives channel `out`.
std::size_t place_of(const TileShape& shape, Index in, Index out, Index place) {
    const Index block = (out / lanes * shape.in + in / lanes) * shape.places() + place;
    return at((block * lanes + in % lanes) * lanes + out % lanes);
}

}  // namespace

constinit const TileLoops portable_tile_loops = TileLoopsBody<Portable>::table();

const TileLoops& tile_loops() { return onednn::has_avx2() ? avx2_tile_loops : portable_tile_loops; }

TiledConvolution::TiledConvolution(Extent x, Extent y, int side, int board, const TileLoops& loops)
    : loops_(loops),
      x_(x),
      y_(y),
      shape_{x.blocks(), y.blocks(), side, board},
      kernel_(at(shape_.in * shape_.out * shape_.places() * lanes * lanes)),
      turned_kernel_(kernel_.size()),
      bias_(at(shape_.out * lanes)),
      no_bias_(at(shape_.in * lanes)),
      frame_(at(std::max(shape_.in, shape_.out) * shape_.framed() * shape_.framed() * lanes)),
      sums_(kernel_.size()) {}

// What flows back is a convolution too: by the same numbers, the kernel turned by half a circle.
void TiledConvolution::load(const float* kernel, const float* bias) {
    const Index places = shape_.places();
    const auto turned = shape_.turned();
    for (Index out = 0; out < y_.channels; ++out)
        for (Index in = 0; in < x_.channels; ++in)
            for (Index place = 0; place < places; ++place) {
                const float weight = *kernel++;
                kernel_[place_of(shape_, in, out, place)] = weight;
                turned_kernel_[place_of(turned, out, in, places - 1 - place)] = weight;
            }
    if (bias) std::copy_n(bias, y_.channels, bias_.begin());
}

// The border was zero at first and nobody writes there. Blocks of x and of y are framed alike.
const float* TiledConvolution::frame(const float* sample, Index blocks) {
    const Index framed = shape_.framed(), margin = shape_.side / 2;
    for (Index block = 0; block < blocks; ++block)
        for (Index row = 0; row < shape_.board; ++row)
            std::copy_n(
                sample + (block * shape_.board + row) * shape_.board * lanes, shape_.board * lanes,
                frame_.data() + ((block * framed + row + margin) * framed + margin) * lanes);
    return frame_.data();
}

void TiledConvolution::forward(const float* x, float* y) {
    const Index points = shape_.points() * lanes;
    for (Index sample = 0; sample < x_.samples; ++sample)
        loops_.convolve(shape_, frame(x + sample * shape_.in * points, shape_.in), kernel_.data(),
                        bias_.data(), y + sample * shape_.out * points);
}

void TiledConvolution::backward_data(const float* y_gradient, float* x_gradient) {
    const Index points = shape_.points() * lanes;
    for (Index sample = 0; sample < x_.samples; ++sample)
        loops_.convolve(
            shape_.turned(), frame(y_gradient + sample * shape_.out * points, shape_.out),
            turned_kernel_.data(), no_bias_.data(), x_gradient + sample * shape_.in * points);
}

void TiledConvolution::backward_weights(const float* x, const float* y_gradient) {
    const Index points = shape_.points() * lanes;
    for (Index sample = 0; sample < x_.samples; ++sample)
        loops_.add_products(shape_, frame(x + sample * shape_.in * points, shape_.in),
                            y_gradient + sample * shape_.out * points, sums_.data());
}

void TiledConvolution::collect(float* kernel) {
    for (Index out = 0; out < y_.channels; ++out)
        for (Index in = 0; in < x_.channels; ++in)
            for (Index place = 0; place < shape_.places(); ++place)
                *kernel++ += sums_[place_of(shape_, in, out, place)];
    std::fill(sums_.begin(), sums_.end(), 0.0f);
}

}  // namespace nn::training
