// First convolutions, pooling, dense layers and what is done point by point, for any instruction
// set `Isa`. For the kernels; no standard library code.
#pragma once

#include "nn/winograd/finisher.h"

namespace nn::winograd {

// Which of 2 r + 1 ways the kernel is cut at this row or column; the board is at least as wide.
template <class Isa>
int border_class(int at, int side, int radius) {
    if (at < radius) return at;
    const int after = side - 1 - at;
    return after < radius ? 2 * radius - after : radius;
}

template <class Isa, int width, class Finisher>
void first_point(const FirstJob& job, const Finisher& finisher, int y, int x, int channel) {
    const auto& f = finisher.finish();
    const int side = f.board.side, radius = job.kernel / 2;
    const std::ptrdiff_t column = job.planes * f.channels;
    // Two sets of sums, for even and odd entries: one would wait for its own additions.
    typename Isa::Floats even[width], odd[width];
    const int border =
        border_class<Isa>(y, side, radius) * job.kernel + border_class<Isa>(x, side, radius);
    repeat<width>([&](auto w) __attribute__((always_inline)) {
        even[w] = job.borders ? Isa::load(job.borders + border * f.channels + channel + w * lanes)
                              : Isa::set(0);
        odd[w] = Isa::set(0);
    });
    const int left = x < radius ? 0 : x - radius;
    const int right = x + radius >= side ? side - 1 : x + radius;
    for (int ky = 0; ky < job.kernel; ++ky) {
        const int row = y + ky - radius;
        if (row < 0 || row >= side) continue;
        const float* weights = job.weights + (ky * job.kernel - (x - radius)) * column + channel;
        const Entry* entry = job.entries + job.starts[row * side + left];
        const Entry* end = job.entries + job.starts[row * side + right + 1];
        const auto add = [&](auto& sums) __attribute__((always_inline)) {
            const auto value = Isa::set(entry->value);
            const float* from = weights + entry->offset;
            ++entry;
            repeat<width>([&](auto w) __attribute__((always_inline)) {
                sums[w] = Isa::fused(value, Isa::load(from + w * lanes), sums[w]);
            });
        };
        while (end - entry >= 2) {
            add(even);
            add(odd);
        }
        if (entry != end) add(even);
    }
    repeat<width>([&](auto w) __attribute__((always_inline)) {
        finisher.apply(even[w] + odd[w], job.position, y, x, channel + w * lanes);
    });
}

template <class Isa, int width, class Finisher>
void first_channels(const FirstJob& job, const Finisher& finisher, int channel) {
    const int side = finisher.finish().board.side;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) first_point<Isa, width>(job, finisher, y, x, channel);
}

template <class Isa>
void first(const FirstJob& job, const Finish& how) {
    with_finisher<Isa>(how, [&](const auto& finisher) {
        int channel = 0;
        for (; how.channels - channel >= Isa::first_width * lanes;
             channel += Isa::first_width * lanes)
            first_channels<Isa, Isa::first_width>(job, finisher, channel);
        for (; channel < how.channels; channel += lanes)
            first_channels<Isa, 1>(job, finisher, channel);
    });
}

template <class Isa>
void pointwise(const PointwiseJob& job, const Finish& how) {
    with_finisher<Isa>(how, [&](const auto& finisher) {
        const float* source = job.source;
        for (int position = 0; position < job.positions; ++position)
            for (int y = 0; y < how.board.side; ++y)
                for (int x = 0; x < how.board.side; ++x, source += how.channels)
                    for (int c = 0; c < how.channels; c += lanes) {
                        auto v = Isa::load(source + c);
                        if (job.scale)
                            v = v * Isa::load(job.scale + position * job.scale_stride + c);
                        finisher.apply(v, position, y, x, c);
                    }
    });
}

template <class Isa>
void pool(const PoolJob& job) {
    const auto share = Isa::set(1.0f / static_cast<float>(job.points));
    for (int c = 0; c < job.channels; c += lanes) {
        auto sum = Isa::set(0), most = Isa::load(job.source + c);
        const float* from = job.source + c;
        for (int p = 0; p < job.points; ++p, from += job.channels) {
            sum = sum + Isa::load(from);
            most = Isa::maximum(most, Isa::load(from));
        }
        Isa::store(job.mean + c, sum * share);
        Isa::store(job.maximum + c, most);
    }
}

template <class Isa, int positions>
void dense_positions(const DenseJob& job, int first_position, int output) {
    constexpr int width = 2;
    const float* input = job.input + first_position * job.input_stride;
    typename Isa::Floats sums[positions][width];
    const bool pair = output + lanes < job.outputs;
    const int second = pair ? lanes : 0;
    repeat<positions>([&](auto p) __attribute__((always_inline)) {
        sums[p][0] = Isa::load(job.bias + output);
        sums[p][1] = Isa::load(job.bias + output + second);
    });
    const float* weights = job.weights + output;
    for (int i = 0; i < job.inputs; ++i, weights += job.outputs) {
        const auto one = Isa::load(weights), two = Isa::load(weights + second);
        repeat<positions>([&](auto p) __attribute__((always_inline)) {
            const auto value = Isa::set(input[p * job.input_stride + i]);
            sums[p][0] = Isa::fused(value, one, sums[p][0]);
            sums[p][1] = Isa::fused(value, two, sums[p][1]);
        });
    }
    repeat<positions>([&](auto p) __attribute__((always_inline)) {
        float* out = job.out + (first_position + p) * job.out_stride + output;
        Isa::store(out, sums[p][0]);
        if (pair) Isa::store(out + lanes, sums[p][1]);
    });
}

template <class Isa>
void dense(const DenseJob& job) {
    for (int output = 0; output < job.outputs; output += 2 * lanes) {
        int position = 0;
        for (; job.positions - position >= 4; position += 4)
            dense_positions<Isa, 4>(job, position, output);
        for (; position < job.positions; ++position) dense_positions<Isa, 1>(job, position, output);
    }
}

template <class Isa>
void activate(Curve kind, float* values, int count) {
    for (int i = 0; i < count; i += lanes)
        Isa::store(values + i, curve<Isa>(kind, Isa::load(values + i)));
}

template <class Isa>
std::uint64_t nonzero(const float* values, int count) {
    std::uint64_t bits = 0;
    int i = 0;
    for (; count - i >= lanes; i += lanes)
        bits |= static_cast<std::uint64_t>(Isa::nonzero(Isa::load(values + i))) << i;
    for (; i < count; ++i) bits |= static_cast<std::uint64_t>(values[i] != 0) << i;
    return bits;
}

// Enough sums to hide the latency of the multiply-add, each from a start of its own, or the
// compiler would see that they are one.
template <class Isa>
std::int64_t peak(std::int64_t rounds) {
    constexpr int chains = Isa::peak_chains;
    std::int16_t starts[2 * (lanes + chains)];
    for (int i = 0; i < 2 * (lanes + chains); ++i) starts[i] = static_cast<std::int16_t>(i);
    typename Isa::Sums sums[chains];
    const auto input = Isa::broadcast_pair(starts);
    const auto weight = Isa::load_pairs(starts);
    repeat<chains>([&](auto c) __attribute__((always_inline)) {
        sums[c] = Isa::zero();
        Isa::multiply_add(sums[c], input, Isa::load_pairs(starts + 2 * c));
    });
    for (std::int64_t i = 0; i < rounds; ++i)
        repeat<chains>([&](auto c) __attribute__((always_inline)) {
            Isa::multiply_add(sums[c], input, weight);
        });
    auto total = Isa::set(0);
    repeat<chains>([&](auto c)
                       __attribute__((always_inline)) { total = total + Isa::to_floats(sums[c]); });
    float numbers[lanes];
    Isa::store(numbers, total);
    // Reading what was summed keeps the loop from being dropped.
    return rounds * chains * 2 * lanes + (numbers[0] == 0.5f ? 1 : 0);
}

}  // namespace nn::winograd
