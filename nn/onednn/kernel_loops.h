// The loops behind kernels.h, for the files that compile them for one instruction set each. All
// have internal linkage and call no inline library code, so that no faster copy of a shared
// function can end up where a slower processor runs.
#pragma once

#include <math.h>

#include "nn/onednn/kernels.h"

namespace nn::onednn {
namespace {

constexpr int chunk = 64;

inline int smaller(int a, int b) { return a < b ? a : b; }
inline float clamped(float x, float low, float high) {
    const float above = x < low ? low : x;
    return above > high ? high : above;
}

// Cephes' expf: 2^k e^r with |r| <= ln(2) / 2.
inline float exponential(float x) {
    x = clamped(x, -87.0f, 88.0f);
    const float shifted = x * 1.44269504f;
    const int k = static_cast<int>(shifted + (shifted < 0 ? -0.5f : 0.5f));
    const float whole = static_cast<float>(k);
    const float r = x - whole * 0.693359375f + whole * 2.12194440e-4f;
    float p = 1.9875691500e-4f;
    p = p * r + 1.3981999507e-3f;
    p = p * r + 8.3334519073e-3f;
    p = p * r + 4.1665795894e-2f;
    p = p * r + 1.6666665459e-1f;
    p = p * r + 5.0000001201e-1f;
    p = p * r * r + r + 1;
    return p * __builtin_bit_cast(float, (k + 127) << 23);
}

inline float mish(float x) {
    const float e = exponential(x < 20 ? x : 20);
    const float n = e * (e + 2);
    return x * (n / (n + 2));
}

template <class Function>
void each(float* values, int count, Function function) {
    for (int i = 0; i < count; ++i) values[i] = function(values[i]);
}

void activate_all(Activation kind, float* v, int n) {
    switch (kind) {
        case Activation::identity:
            return;
        case Activation::relu:
            return each(v, n, [](float x) { return x > 0 ? x : 0.0f; });
        case Activation::mish:
            return each(v, n, mish);
        case Activation::silu:
            return each(v, n, [](float x) { return x / (1 + exponential(-x)); });
        case Activation::tanh:
            return each(v, n, [](float x) { return 1 - 2 / (exponential(2 * x) + 1); });
        case Activation::sigmoid:
            return each(v, n, [](float x) { return 1 / (1 + exponential(-x)); });
        case Activation::softplus:
            return each(v, n, [](float x) {
                return (x > 0 ? x : 0.0f) + ::log1pf(::expf(x > 0 ? -x : x));
            });
        case Activation::square_root:
            return each(v, n, [](float x) { return ::sqrtf(x > 0 ? x : 0.0f); });
    }
}

void store(const float* v, void* out, Format format, std::ptrdiff_t at, int n) {
    if (format == Format::f32) {
        float* to = static_cast<float*>(out) + at;
        for (int i = 0; i < n; ++i) to[i] = v[i];
    } else if (format == Format::bf16) {
        auto* to = static_cast<unsigned short*>(out) + at;
        for (int i = 0; i < n; ++i) {
            const auto bits = __builtin_bit_cast(unsigned, v[i]);
            to[i] = static_cast<unsigned short>((bits + 0x7fff + ((bits >> 16) & 1)) >> 16);
        }
    } else if (format == Format::u8) {
        auto* to = static_cast<unsigned char*>(out) + at;
        for (int i = 0; i < n; ++i)
            to[i] = static_cast<unsigned char>(static_cast<int>(clamped(v[i], 0, 255) + 0.5f));
    } else {
        auto* to = static_cast<signed char*>(out) + at;
        for (int i = 0; i < n; ++i)
            to[i] =
                static_cast<signed char>(static_cast<int>(clamped(v[i], -127, 127) + 128.5f) - 128);
    }
}

void transform_chunk(const Transform& t, std::ptrdiff_t row, std::ptrdiff_t factors, int c, int n) {
    float v[chunk];
    const float* in = t.in + row + c;
    for (int i = 0; i < n; ++i) v[i] = in[i];
    if (t.scale != nullptr)
        for (int i = 0; i < n; ++i) v[i] *= t.scale[factors + c + i];
    if (t.shift != nullptr)
        for (int i = 0; i < n; ++i) v[i] += t.shift[factors + c + i];
    if (t.residual != nullptr)
        for (int i = 0; i < n; ++i) v[i] += t.residual[row + c + i];
    activate_all(t.activation, v, n);
    if (t.exact != nullptr) store(v, t.exact, Format::f32, row + c, n);
    if (t.post != nullptr)
        for (int i = 0; i < n; ++i) v[i] *= t.post[c + i];
    store(v, t.out, t.format, row + c, n);
}

// Sixteen numbers; the compiler splits them where registers are shorter.
constexpr int lanes = 16;
using Floats [[gnu::vector_size(lanes * 4)]] = float;
using Words [[gnu::vector_size(lanes * 4)]] = int;
using Halves [[gnu::vector_size(lanes * 2)]] = unsigned short;
using Octets [[gnu::vector_size(lanes)]] = unsigned char;

inline Floats load(const float* from) {
    Floats v;
    __builtin_memcpy(&v, from, sizeof v);
    return v;
}
template <class Vector>
inline void put(const Vector& v, void* to, std::ptrdiff_t at) {
    __builtin_memcpy(static_cast<char*>(to) + at * static_cast<std::ptrdiff_t>(sizeof v / lanes),
                     &v, sizeof v);
}
inline Floats clamped(const Floats& v, const Floats& low, const Floats& high) {
    const Floats above = v > low ? v : low;
    return above < high ? above : high;
}

template <Format format>
inline void put_as(const Floats& v, void* out, std::ptrdiff_t at) {
    const Floats none = {};
    if constexpr (format == Format::f32) {
        put(v, out, at);
    } else if constexpr (format == Format::bf16) {
        const auto bits = __builtin_bit_cast(Words, v);
        put(__builtin_convertvector((bits + 0x7fff + ((bits >> 16) & 1)) >> 16, Halves), out, at);
    } else if constexpr (format == Format::u8) {
        const auto whole = clamped(v, none, none + 255) + 0.5f;
        put(__builtin_convertvector(__builtin_convertvector(whole, Words), Octets), out, at);
    } else {
        const auto whole = clamped(v, none - 127, none + 127) + 128.5f;
        put(__builtin_convertvector(__builtin_convertvector(whole, Words) - 128, Octets), out, at);
    }
}

// A factor or term that is not there is read as a vector of ones or zeros.
struct Source {
    const float* data;
    std::ptrdiff_t mask;  // of offsets
    Floats at(std::ptrdiff_t offset) const { return load(data + (offset & mask)); }
};
inline Source source_or(const float* data, const float* otherwise) {
    return data != nullptr ? Source{data, -1} : Source{otherwise, 0};
}

constexpr float ones[lanes] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
constexpr float zeros[lanes] = {};

// The channels of all points that fill whole vectors.
template <Format format, bool positive>
void transform_vectors(Transform t) {
    const auto scale = source_or(t.scale, ones), shift = source_or(t.shift, zeros);
    const auto residual = source_or(t.residual, zeros), post = source_or(t.post, ones);
    const Floats none = {};
    std::ptrdiff_t row = 0;
    for (int position = 0; position < t.positions; ++position)
        for (int point = 0; point < t.points; ++point, row += t.channels)
            for (int c = 0; c + lanes <= t.channels; c += lanes) {
                const std::ptrdiff_t factor = t.step * position + c;
                Floats v = load(t.in + row + c) * scale.at(factor) + shift.at(factor) +
                           residual.at(row + c);
                if constexpr (positive) v = v > none ? v : none;
                if (t.exact != nullptr) put(v, t.exact, row + c);
                put_as<format>(v * post.at(c), t.out, row + c);
            }
}

template <Format format>
void transform_vectors(Transform t) {
    if (t.activation == Activation::relu) return transform_vectors<format, true>(t);
    transform_vectors<format, false>(t);
}

void transform_from(const Transform& t, int first) {
    std::ptrdiff_t row = 0;
    for (int position = 0; position < t.positions; ++position)
        for (int point = 0; point < t.points; ++point, row += t.channels)
            for (int c = first; c < t.channels; c += chunk)
                transform_chunk(t, row, t.step * position, c, smaller(chunk, t.channels - c));
}

void transform(const Transform& t) {
    if (t.activation > Activation::relu) return transform_from(t, 0);
    switch (t.format) {
        case Format::f32:
            transform_vectors<Format::f32>(t);
            break;
        case Format::bf16:
            transform_vectors<Format::bf16>(t);
            break;
        case Format::u8:
            transform_vectors<Format::u8>(t);
            break;
        case Format::s8:
            transform_vectors<Format::s8>(t);
            break;
    }
    if (t.channels % lanes != 0) transform_from(t, t.channels / lanes * lanes);
}

// Sum and maximum over all points of the channels at `first`: as many as a Number holds. `most` may
// be null.
template <class Number>
void gather(const Pool& p, const float* in, int first, float* sum, float* most) {
    Number total, x;
    __builtin_memcpy(&total, in + first, sizeof total);
    Number highest = total;
    for (int point = 1; point < p.points; ++point) {
        __builtin_memcpy(&x, in + std::ptrdiff_t{point} * p.channels + first, sizeof x);
        total += x;
        highest = x > highest ? x : highest;
    }
    __builtin_memcpy(sum + first, &total, sizeof total);
    if (most != nullptr) __builtin_memcpy(most + first, &highest, sizeof highest);
}

void pool_one(const Pool& p, const float* in, float* out) {
    float* third = out + std::ptrdiff_t{2} * p.channels;
    float* most = p.pooling == Pooling::mean_maximum ? third : nullptr;
    int done = 0;
    for (; done + lanes <= p.channels; done += lanes) gather<Floats>(p, in, done, out, most);
    for (; done < p.channels; ++done) gather<float>(p, in, done, out, most);
    for (int c = 0; c < p.channels; ++c) out[c] /= static_cast<float>(p.points);
    if (p.pooling == Pooling::mean) return;
    const float d = p.side - 14;
    for (int c = 0; c < p.channels; ++c) out[p.channels + c] = out[c] * (d * 0.1f);
    if (p.pooling == Pooling::mean_quadratic)
        for (int c = 0; c < p.channels; ++c) third[c] = out[c] * (d * d * 0.01f - 0.1f);
}

void pool(const Pool& p) {
    const std::ptrdiff_t width = std::ptrdiff_t{p.channels} * (p.pooling == Pooling::mean ? 1 : 3);
    for (int i = 0; i < p.positions; ++i)
        pool_one(p, p.in + std::ptrdiff_t{i} * p.points * p.channels, p.out + i * width);
}

template <int... lane>
struct Lanes {};
using AllLanes = Lanes<0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15>;

// Of the square of two rows by twice `width` columns, and its likes along both, the two blocks off
// the diagonal change places.
template <int width, int... lane>
inline void exchange(Floats& a, Floats& b, Lanes<lane...>) {
    const Floats upper = a;
    a = __builtin_shufflevector(upper, b, ((lane & width) == 0 ? lane : lanes + lane - width)...);
    b = __builtin_shufflevector(upper, b, ((lane & width) == 0 ? lane + width : lanes + lane)...);
}
template <int width>
inline void exchange(Floats* rows) {
    for (int i = 0; i < lanes; ++i)
        if ((i & width) == 0) exchange<width>(rows[i], rows[i + width], AllLanes());
}

// A square of sixteen rows, so far apart in memory, its rows made its columns.
struct Square {
    Square(const float* from, std::ptrdiff_t distance) {
        for (int i = 0; i < lanes; ++i) rows[i] = load(from + i * distance);
        exchange<8>(rows);
        exchange<4>(rows);
        exchange<2>(rows);
        exchange<1>(rows);
    }
    Floats rows[lanes];
};

// Calls action(first, second) for squares that cover a * b, the last ones overlapping; false where
// none fits.
template <class Action>
bool cover(int a, int b, Action action) {
    if (a < lanes || b < lanes) return false;
    for (int i = 0; i < a; i += lanes)
        for (int j = 0; j < b; j += lanes) action(smaller(i, a - lanes), smaller(j, b - lanes));
    return true;
}

// One number of a position after another.
void to_rows_singly(const Turn& t, const float* planes, std::ptrdiff_t row) {
    for (int point = 0; point < t.points; ++point, row += t.channels)
        for (int c = 0; c < t.channels; c += chunk) {
            const int n = smaller(chunk, t.channels - c);
            float v[chunk];
            for (int j = 0; j < n; ++j) v[j] = planes[std::ptrdiff_t{c + j} * t.points + point];
            if (t.post != nullptr)
                for (int j = 0; j < n; ++j) v[j] *= t.post[c + j];
            store(v, t.out, t.format, row + c, n);
        }
}

template <Format format>
void to_rows(const Turn& t) {
    const auto post = source_or(t.post, ones);
    const std::ptrdiff_t size = std::ptrdiff_t{t.points} * t.channels;
    for (int i = 0; i < t.positions; ++i) {
        const float* planes = t.in + i * size;
        const bool covered = cover(t.channels, t.points, [&](int channel, int point) {
            const Square turned(planes + std::ptrdiff_t{channel} * t.points + point, t.points);
            const Floats factor = post.at(channel);
            std::ptrdiff_t row = i * size + std::ptrdiff_t{point} * t.channels + channel;
            for (const Floats& v : turned.rows) {
                put_as<format>(v * factor, t.out, row);
                row += t.channels;
            }
        });
        if (!covered) to_rows_singly(t, planes, i * size);
    }
}

void to_rows(const Turn& t) {
    switch (t.format) {
        case Format::f32:
            return to_rows<Format::f32>(t);
        case Format::bf16:
            return to_rows<Format::bf16>(t);
        case Format::u8:
            return to_rows<Format::u8>(t);
        case Format::s8:
            return to_rows<Format::s8>(t);
    }
}

void to_planes(const Turn& t) {
    const std::ptrdiff_t size = std::ptrdiff_t{t.points} * t.channels;
    for (int i = 0; i < t.positions; ++i) {
        const float* rows = t.in + i * size;
        float* out = static_cast<float*>(t.out) + i * size;
        const bool covered = cover(t.points, t.channels, [&](int point, int channel) {
            const Square turned(rows + std::ptrdiff_t{point} * t.channels + channel, t.channels);
            float* to = out + std::ptrdiff_t{channel} * t.points + point;
            for (const Floats& v : turned.rows) {
                put(v, to, 0);
                to += t.points;
            }
        });
        if (covered) continue;
        if (t.points == 1) {
            for (int c = 0; c < t.channels; ++c) out[c] = rows[c];
            continue;
        }
        for (int c = 0; c < t.channels; ++c, out += t.points)
            for (int point = 0; point < t.points; ++point)
                out[point] = rows[std::ptrdiff_t{point} * t.channels + c];
    }
}

void small_block_of(const Small& s, int row, int first) {
    float sum[small_block];
    for (int o = 0; o < small_block; ++o) sum[o] = 0;
    const float* weights = s.weights + std::ptrdiff_t{first} * s.ins;
    const float* in = s.in + std::ptrdiff_t{row} * s.ins;
    for (int i = 0; i < s.ins; ++i, weights += small_block) {
        const float x = in[i];
        for (int o = 0; o < small_block; ++o) sum[o] += x * weights[o];
    }
    const int n = smaller(small_block, s.outs - first);
    const std::ptrdiff_t at = std::ptrdiff_t{row} * s.outs + first;
    if (s.bias != nullptr)
        for (int o = 0; o < n; ++o) sum[o] += s.bias[first + o];
    if (s.residual != nullptr)
        for (int o = 0; o < n; ++o) sum[o] += s.residual[at + o];
    activate_all(s.activation, sum, n);
    for (int o = 0; o < n; ++o) s.out[at + o] = sum[o];
}

// One output: a product of two vectors, sixteen sums at a time.
float product(const float* a, const float* b, int count) {
    float sums[16] = {};
    int i = 0;
    for (; i + 16 <= count; i += 16)
        for (int j = 0; j < 16; ++j) sums[j] += a[i + j] * b[i + j];
    float sum = 0;
    for (; i < count; ++i) sum += a[i] * b[i];
    for (int j = 0; j < 16; ++j) sum += sums[j];
    return sum;
}

void single(const Small& s) {
    for (int row = 0; row < s.rows; ++row) {
        float sum = product(s.in + std::ptrdiff_t{row} * s.ins, s.weights, s.ins);
        if (s.bias != nullptr) sum += s.bias[0];
        if (s.residual != nullptr) sum += s.residual[row];
        s.out[row] = sum;
    }
    activate_all(s.activation, s.out, s.rows);
}

void small(const Small& s) {
    if (s.outs == 1) return single(s);
    for (int first = 0; first < s.outs; first += small_block)
        for (int row = 0; row < s.rows; ++row) small_block_of(s, row, first);
}

constexpr Kernels loops = {transform, pool, to_rows, to_planes, small};

}  // namespace
}  // namespace nn::onednn
