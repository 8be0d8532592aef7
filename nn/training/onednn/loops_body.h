// The loops of blocked.h, over vectors of 16 floats that the compiler maps to what the processor
// has. Only for the files that compile them: each passes a type of its own as Build, so that code
// for one instruction set never stands in for another's; and no library code is included.
#pragma once

#include "nn/training/onednn/blocked.h"

namespace nn::training {

template <class Build, class Number>
struct LoopsBody {
    using Vector = float __attribute__((vector_size(64)));
    using Bits = std::uint32_t __attribute__((vector_size(64)));
    using Halves = std::uint16_t __attribute__((vector_size(32)));

    static Vector load(const float* from) {
        Vector v;
        __builtin_memcpy(&v, from, sizeof v);
        return v;
    }
    static Vector load(const Bf16* from) {
        Halves halves;
        __builtin_memcpy(&halves, from, sizeof halves);
        return reinterpret_cast<Vector>(__builtin_convertvector(halves, Bits) << 16);
    }
    static void store(Vector v, float* to) { __builtin_memcpy(to, &v, sizeof v); }
    // To the nearest, halves to even.
    static void store(Vector v, Bf16* to) {
        const Bits bits = reinterpret_cast<Bits>(v);
        const Bits rounded = (bits + 0x7fff + (bits >> 16 & 1)) >> 16;
        const Halves halves = __builtin_convertvector(rounded, Halves);
        __builtin_memcpy(to, &halves, sizeof halves);
    }
    static Vector where_positive(Vector y, Vector x) {
        return reinterpret_cast<Vector>(reinterpret_cast<Bits>(x) & reinterpret_cast<Bits>(y > 0));
    }
    static void add_to(Vector v, float* sums) { store(load(sums) + v, sums); }

    static float number(float x) { return x; }
    static float number(Bf16 x) { return __builtin_bit_cast(float, std::uint32_t{x.bits} << 16); }
    static void assign(float x, float& to) { to = x; }
    static void assign(float x, Bf16& to) {
        const auto bits = __builtin_bit_cast(std::uint32_t, x);
        to.bits = static_cast<std::uint16_t>((bits + 0x7fff + (bits >> 16 & 1)) >> 16);
    }

    // Calls visit(first channel, offset) for the tile of every sample and block.
    template <class Visit>
    static void for_tiles(Extent extent, Visit visit) {
        for (std::size_t t = 0; t < extent.tiles(); ++t)
            visit(t % std::size_t(extent.blocks()) * lanes, t * extent.tile());
    }

    static void block(Extent extent, const float* plain, Number* blocked) {
        const auto points = std::size_t(extent.points), channels = std::size_t(extent.channels);
        std::size_t tile = 0;
        for_tiles(extent, [&](std::size_t channel, std::size_t offset) {
            const float* from =
                plain + (tile++ / std::size_t(extent.blocks()) * channels + channel) * points;
            for (std::size_t lane = 0; lane < lanes; ++lane)
                for (std::size_t p = 0; p < points; ++p)
                    assign(channel + lane < channels ? from[lane * points + p] : 0.0f,
                           blocked[offset + p * lanes + lane]);
        });
    }

    static void unblock(Extent extent, const Number* blocked, float* plain, bool add) {
        const auto points = std::size_t(extent.points), channels = std::size_t(extent.channels);
        std::size_t tile = 0;
        for_tiles(extent, [&](std::size_t channel, std::size_t offset) {
            float* to =
                plain + (tile++ / std::size_t(extent.blocks()) * channels + channel) * points;
            for (std::size_t lane = 0; lane < lanes && channel + lane < channels; ++lane)
                for (std::size_t p = 0; p < points; ++p) {
                    const float x = number(blocked[offset + p * lanes + lane]);
                    to[lane * points + p] = add ? to[lane * points + p] + x : x;
                }
        });
    }

    static void sum(std::size_t count, const Number* a, const Number* b, Number* out) {
        for (std::size_t i = 0; i < count; i += lanes) store(load(a + i) + load(b + i), out + i);
    }
    static void relu(std::size_t count, const Number* x, Number* y) {
        for (std::size_t i = 0; i < count; i += lanes)
            store(where_positive(load(x + i), load(x + i)), y + i);
    }
    static void mask(std::size_t count, const Number* y, Number* gradient) {
        for (std::size_t i = 0; i < count; i += lanes)
            store(where_positive(load(y + i), load(gradient + i)), gradient + i);
    }

    static void moments(Extent extent, const Number* x, float* sums, float* squares) {
        products(extent, x, x, sums, squares);
    }

    static void products(Extent extent, const Number* x, const Number* gradient, float* sums,
                         float* products) {
        for_tiles(extent, [&](std::size_t channel, std::size_t offset) {
            Vector sum = {}, product = {};
            for (std::size_t i = offset; i < offset + extent.tile(); i += lanes) {
                const Vector g = load(gradient + i);
                sum += g;
                product += g * load(x + i);
            }
            add_to(sum, sums + channel);
            add_to(product, products + channel);
        });
    }

    template <bool with_residual, bool with_relu>
    static void normalise_as(Extent extent, const Number* x, const float* scale, const float* shift,
                             const Number* residual, Number* y) {
        for_tiles(extent, [&](std::size_t channel, std::size_t offset) {
            const Vector a = load(scale + channel), b = load(shift + channel);
            for (std::size_t i = offset; i < offset + extent.tile(); i += lanes) {
                Vector v = load(x + i) * a + b;
                if constexpr (with_residual) v += load(residual + i);
                if constexpr (with_relu) v = where_positive(v, v);
                store(v, y + i);
            }
        });
    }
    static void normalise(Extent extent, const Number* x, const float* scale, const float* shift,
                          const Number* residual, bool relu, Number* y) {
        if (residual && relu) return normalise_as<true, true>(extent, x, scale, shift, residual, y);
        if (residual) return normalise_as<true, false>(extent, x, scale, shift, residual, y);
        if (relu) return normalise_as<false, true>(extent, x, scale, shift, residual, y);
        normalise_as<false, false>(extent, x, scale, shift, residual, y);
    }

    static void norm_gradient(Extent extent, const Number* x, const Number* gradient,
                              const float* const abc[3], bool add, Number* out) {
        for_tiles(extent, [&](std::size_t channel, std::size_t offset) {
            const Vector a = load(abc[0] + channel), b = load(abc[1] + channel),
                         c = load(abc[2] + channel);
            for (std::size_t i = offset; i < offset + extent.tile(); i += lanes) {
                Vector v = load(gradient + i) * a + (load(x + i) * b + c);
                if (add) v += load(out + i);
                store(v, out + i);
            }
        });
    }

    static constexpr Loops<Number> table() {
        return {block, unblock, sum, relu, mask, moments, normalise, products, norm_gradient};
    }
};

}  // namespace nn::training
