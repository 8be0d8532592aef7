// AVX2: a vector is two registers. Compiled with its own flags, called only where best_kernels has
// found them.
#include <immintrin.h>

#include "nn/winograd/kernel_table.h"

namespace nn::winograd {

namespace {

struct Floats {
    __m256 low, high;
};
struct Words {
    __m256i low, high;
};

Floats operator+(Floats a, Floats b) {
    return {_mm256_add_ps(a.low, b.low), _mm256_add_ps(a.high, b.high)};
}
Floats operator-(Floats a, Floats b) {
    return {_mm256_sub_ps(a.low, b.low), _mm256_sub_ps(a.high, b.high)};
}
Floats operator*(Floats a, Floats b) {
    return {_mm256_mul_ps(a.low, b.low), _mm256_mul_ps(a.high, b.high)};
}
Floats operator/(Floats a, Floats b) {
    return {_mm256_div_ps(a.low, b.low), _mm256_div_ps(a.high, b.high)};
}
Words operator+(Words a, Words b) {
    return {_mm256_add_epi16(a.low, b.low), _mm256_add_epi16(a.high, b.high)};
}
Words operator-(Words a, Words b) {
    return {_mm256_sub_epi16(a.low, b.low), _mm256_sub_epi16(a.high, b.high)};
}

template <int factor>
Floats times(Floats a) {
    const auto by = _mm256_set1_ps(factor);
    return {_mm256_mul_ps(a.low, by), _mm256_mul_ps(a.high, by)};
}
template <int factor>
Words times(Words a) {
    constexpr int shift = factor == 2 ? 1 : 2;
    return {_mm256_slli_epi16(a.low, shift), _mm256_slli_epi16(a.high, shift)};
}

__m256 power_of_two(__m256 n) {
    const auto exponent = _mm256_add_epi32(_mm256_cvtps_epi32(n), _mm256_set1_epi32(127));
    return _mm256_castsi256_ps(_mm256_slli_epi32(exponent, 23));
}

struct Avx2 {
    using Floats = winograd::Floats;
    using Words = winograd::Words;
    using Sums = winograd::Words;
    struct Pairs {
        __m256i low, high;
    };
    static constexpr int first_width = 2, peak_chains = 6;
    // 16 registers: the sums, two of weights, an input and a product.
    static constexpr int most_rows(int width) { return width == 1 ? 6 : width == 2 ? 3 : 2; }

    static Floats load(const float* from) {
        return {_mm256_loadu_ps(from), _mm256_loadu_ps(from + 8)};
    }
    static void store(float* to, Floats a) {
        _mm256_storeu_ps(to, a.low);
        _mm256_storeu_ps(to + 8, a.high);
    }
    static Floats set(float x) { return {_mm256_set1_ps(x), _mm256_set1_ps(x)}; }
    static Floats fused(Floats a, Floats b, Floats c) {
        return {_mm256_fmadd_ps(a.low, b.low, c.low), _mm256_fmadd_ps(a.high, b.high, c.high)};
    }
    static Floats minimum(Floats a, Floats b) {
        return {_mm256_min_ps(a.low, b.low), _mm256_min_ps(a.high, b.high)};
    }
    static Floats maximum(Floats a, Floats b) {
        return {_mm256_max_ps(a.low, b.low), _mm256_max_ps(a.high, b.high)};
    }
    static Floats square_root(Floats a) { return {_mm256_sqrt_ps(a.low), _mm256_sqrt_ps(a.high)}; }
    static Floats round(Floats a) {
        return {_mm256_round_ps(a.low, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC),
                _mm256_round_ps(a.high, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC)};
    }
    static Floats scale_by_power(Floats a, Floats n) {
        return a * Floats{power_of_two(n.low), power_of_two(n.high)};
    }
    static unsigned nonzero(Floats a) {
        const auto zero = _mm256_setzero_ps();
        const int low = _mm256_movemask_ps(_mm256_cmp_ps(a.low, zero, _CMP_NEQ_UQ));
        const int high = _mm256_movemask_ps(_mm256_cmp_ps(a.high, zero, _CMP_NEQ_UQ));
        return static_cast<unsigned>(low | high << 8);
    }

    static __m256i load_one(const std::int16_t* from) {
        return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
    }
    static Words load_words(const std::int16_t* from) {
        return {load_one(from), load_one(from + 16)};
    }
    static void store_words(std::int16_t* to, Words a) {
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), a.low);
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(to + 16), a.high);
    }
    static void store_rounded(std::int16_t* to, Floats a) {
        // The pack works within halves of a register: the permutation mends the order.
        const auto packed =
            _mm256_packs_epi32(_mm256_cvtps_epi32(a.low), _mm256_cvtps_epi32(a.high));
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(to),
                            _mm256_permute4x64_epi64(packed, _MM_SHUFFLE(3, 1, 2, 0)));
    }

    static Sums zero() { return {_mm256_setzero_si256(), _mm256_setzero_si256()}; }
    static Pairs load_pairs(const std::int16_t* from) {
        return {load_one(from), load_one(from + 16)};
    }
    static Pairs broadcast_pair(const std::int16_t* from) {
        int pair;
        __builtin_memcpy(&pair, from, sizeof pair);
        const auto all = _mm256_set1_epi32(pair);
        return {all, all};
    }
    [[gnu::always_inline]] static void multiply_add(Sums& sum, Pairs a, Pairs b) {
        sum.low = _mm256_add_epi32(sum.low, _mm256_madd_epi16(a.low, b.low));
        sum.high = _mm256_add_epi32(sum.high, _mm256_madd_epi16(a.high, b.high));
    }
    static Floats to_floats(Sums a) {
        return {_mm256_cvtepi32_ps(a.low), _mm256_cvtepi32_ps(a.high)};
    }
};

}  // namespace

const Kernels* avx2_kernels() {
    static constexpr Kernels kernels = kernels_of<Avx2>("avx2", 1);
    return &kernels;
}

}  // namespace nn::winograd
