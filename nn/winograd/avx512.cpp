// AVX-512 with VNNI: compiled with its own flags, called only where best_kernels has found them.
#include <immintrin.h>

#include "nn/winograd/kernel_table.h"

namespace nn::winograd {

namespace {

struct Floats {
    __m512 v;
};
struct Words {
    __m512i v;
};

Floats operator+(Floats a, Floats b) { return {_mm512_add_ps(a.v, b.v)}; }
Floats operator-(Floats a, Floats b) { return {_mm512_sub_ps(a.v, b.v)}; }
Floats operator*(Floats a, Floats b) { return {_mm512_mul_ps(a.v, b.v)}; }
Floats operator/(Floats a, Floats b) { return {_mm512_div_ps(a.v, b.v)}; }
Words operator+(Words a, Words b) { return {_mm512_add_epi16(a.v, b.v)}; }
Words operator-(Words a, Words b) { return {_mm512_sub_epi16(a.v, b.v)}; }

template <int factor>
Floats times(Floats a) {
    return {_mm512_mul_ps(a.v, _mm512_set1_ps(factor))};
}
template <int factor>
Words times(Words a) {
    constexpr unsigned shift = factor == 2 ? 1 : 2;
    return {_mm512_slli_epi16(a.v, shift)};
}

struct Avx512 {
    using Floats = winograd::Floats;
    using Words = winograd::Words;
    using Sums = __m512i;
    using Pairs = __m512i;
    static constexpr int first_width = 4, peak_chains = 16;
    // 32 registers: the sums, the weights and one input.
    static constexpr int most_rows(int width) {
        return width == 4 ? 6 : width == 3 ? 9 : width == 2 ? 13 : 14;
    }

    static Floats load(const float* from) { return {_mm512_loadu_ps(from)}; }
    static void store(float* to, Floats a) { _mm512_storeu_ps(to, a.v); }
    static Floats set(float x) { return {_mm512_set1_ps(x)}; }
    static Floats fused(Floats a, Floats b, Floats c) { return {_mm512_fmadd_ps(a.v, b.v, c.v)}; }
    static Floats minimum(Floats a, Floats b) { return {_mm512_min_ps(a.v, b.v)}; }
    static Floats maximum(Floats a, Floats b) { return {_mm512_max_ps(a.v, b.v)}; }
    static Floats square_root(Floats a) { return {_mm512_sqrt_ps(a.v)}; }
    static Floats round(Floats a) { return {_mm512_roundscale_ps(a.v, 0)}; }
    static Floats scale_by_power(Floats a, Floats n) { return {_mm512_scalef_ps(a.v, n.v)}; }
    static unsigned nonzero(Floats a) {
        return _mm512_cmp_ps_mask(a.v, _mm512_setzero_ps(), _CMP_NEQ_UQ);
    }

    static Words load_words(const std::int16_t* from) { return {_mm512_loadu_si512(from)}; }
    static void store_words(std::int16_t* to, Words a) { _mm512_storeu_si512(to, a.v); }
    static void store_rounded(std::int16_t* to, Floats a) {
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(to),
                            _mm512_cvtepi32_epi16(_mm512_cvtps_epi32(a.v)));
    }

    static Sums zero() { return _mm512_setzero_si512(); }
    static Pairs load_pairs(const std::int16_t* from) { return _mm512_loadu_si512(from); }
    static Pairs broadcast_pair(const std::int16_t* from) {
        int pair;
        __builtin_memcpy(&pair, from, sizeof pair);
        return _mm512_set1_epi32(pair);
    }
    // g++ 12 copies the sums around the intrinsic, at half the speed; the instruction itself it
    // leaves in place.
    [[gnu::always_inline]] static void multiply_add(Sums& sum, Pairs a, Pairs b) {
        asm("vpdpwssd %2, %1, %0" : "+v"(sum) : "v"(a), "v"(b));
    }
    static Floats to_floats(Sums a) { return {_mm512_cvtepi32_ps(a)}; }
};

}  // namespace

const Kernels* avx512_kernels() {
    static constexpr Kernels kernels = kernels_of<Avx512>("avx512-vnni", 4);
    return &kernels;
}

}  // namespace nn::winograd
