// Activations over the board as oneDNN likes them (nChw16c): sample, block of 16 channels, point,
// channel in its block, the last block filled up with zeros. And the loops over them, compiled once
// for every processor, once for AVX2 and once for AVX-512. Used by the oneDNN trainer alone.
#pragma once

#include <cstddef>
#include <cstdint>

namespace nn::training {

constexpr int lanes = 16;  // channels of a block

// The upper half of a float.
struct Bf16 {
    std::uint16_t bits;
};

struct Extent {
    int samples, channels, points;
    int blocks() const { return (channels + lanes - 1) / lanes; }
    std::size_t tiles() const { return std::size_t(samples) * std::size_t(blocks()); }
    std::size_t tile() const { return std::size_t(points) * lanes; }
    std::size_t count() const { return tiles() * tile(); }
};

// Sums, scales and shifts have one number a channel, filled up to whole blocks.
template <class Number>
struct Loops {
    void (*block)(Extent, const float* plain, Number* blocked);
    void (*unblock)(Extent, const Number* blocked, float* plain, bool add);
    void (*sum)(std::size_t count, const Number* a, const Number* b, Number* out);
    void (*relu)(std::size_t count, const Number* x, Number* y);
    // Sets `gradient` to zero where y is not positive.
    void (*mask)(std::size_t count, const Number* y, Number* gradient);
    // Adds to the sums of x and of its squares.
    void (*moments)(Extent, const Number* x, float* sums, float* squares);
    // y = scale x + shift, plus the residual if any, through relu if asked for.
    void (*normalise)(Extent, const Number* x, const float* scale, const float* shift,
                      const Number* residual, bool relu, Number* y);
    // Adds to the sums of the gradient and of its product with x.
    void (*products)(Extent, const Number* x, const Number* gradient, float* sums, float* products);
    // out = a gradient + b x + c, added to what is there if asked for.
    void (*norm_gradient)(Extent, const Number* x, const Number* gradient,
                          const float* const abc[3], bool add, Number* out);
};

// The best for this processor.
template <class Number>
const Loops<Number>& loops();

}  // namespace nn::training
