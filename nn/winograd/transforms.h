// The one-dimensional transforms of F(m, 3), written for few operations; Tiling holds the same as
// matrices, and the tests compare. `V` is a vector with + and - and times<k>, k a power of two.
// For the kernels; no standard library code.
#pragma once

namespace nn::winograd {

template <int tile>
struct Transform;

// Points 0, 1, -1, infinity.
template <>
struct Transform<2> {
    template <class V>
    [[gnu::always_inline]] static void input(const V* d, V* t) {
        t[0] = d[0] - d[2];
        t[1] = d[1] + d[2];
        t[2] = d[2] - d[1];
        t[3] = d[1] - d[3];
    }
    template <class V>
    [[gnu::always_inline]] static void output(const V* p, V* o) {
        o[0] = p[0] + p[1] + p[2];
        o[1] = p[1] - p[2] - p[3];
    }
};

// Points 0, 1, -1, 2, infinity.
template <>
struct Transform<3> {
    template <class V>
    [[gnu::always_inline]] static void input(const V* d, V* t) {
        const V a = d[3] - d[1], b = d[3] - d[2], e = times<2>(d[1]);
        t[0] = times<2>(d[0] - d[2]) + a;
        t[1] = b - e;
        t[2] = b + e - times<2>(d[2]);
        t[3] = a;
        t[4] = d[4] - d[2] - times<2>(a);
    }
    template <class V>
    [[gnu::always_inline]] static void output(const V* p, V* o) {
        const V sum = p[1] + p[2];
        o[0] = p[0] + sum + p[3];
        o[1] = p[1] - p[2] + times<2>(p[3]);
        o[2] = sum + times<4>(p[3]) + p[4];
    }
};

// Points 0, 1, -1, 2, -2, infinity.
template <>
struct Transform<4> {
    template <class V>
    [[gnu::always_inline]] static void input(const V* d, V* t) {
        const V c = d[4] - d[2], f = d[3] - d[1];
        const V a = d[4] - times<4>(d[2]), b = d[3] - times<4>(d[1]);
        const V e = times<2>(f);
        t[0] = times<4>(d[0] - d[2]) + c;
        t[1] = a + b;
        t[2] = a - b;
        t[3] = c + e;
        t[4] = c - e;
        t[5] = d[5] - d[3] - times<4>(f);
    }
    template <class V>
    [[gnu::always_inline]] static void output(const V* p, V* o) {
        const V s = p[1] + p[2], d = p[1] - p[2], u = p[3] + p[4], e = p[3] - p[4];
        o[0] = p[0] + s + u;
        o[1] = d + times<2>(e);
        o[2] = s + times<4>(u);
        o[3] = d + times<8>(e) + p[5];
    }
};

}  // namespace nn::winograd
