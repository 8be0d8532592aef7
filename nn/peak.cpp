#include "nn/peak.h"

namespace nn {

namespace {

#if defined(__x86_64__)

// Each runs twelve chains of one instruction, enough to hide its latency, `rounds` times. Assembly,
// since a compiler drops what has no result.
void fp32_512(std::int64_t rounds) {
    asm volatile(
        "vpxor %%xmm0, %%xmm0, %%xmm0\n"
        "vpxor %%xmm1, %%xmm1, %%xmm1\n"
        "vpxor %%xmm2, %%xmm2, %%xmm2\n"
        "vpxor %%xmm3, %%xmm3, %%xmm3\n"
        "vpxor %%xmm4, %%xmm4, %%xmm4\n"
        "vpxor %%xmm5, %%xmm5, %%xmm5\n"
        "vpxor %%xmm6, %%xmm6, %%xmm6\n"
        "vpxor %%xmm7, %%xmm7, %%xmm7\n"
        "vpxor %%xmm8, %%xmm8, %%xmm8\n"
        "vpxor %%xmm9, %%xmm9, %%xmm9\n"
        "vpxor %%xmm10, %%xmm10, %%xmm10\n"
        "vpxor %%xmm11, %%xmm11, %%xmm11\n"
        "vpxor %%xmm14, %%xmm14, %%xmm14\n"
        "vpxor %%xmm15, %%xmm15, %%xmm15\n"
        "1:\n"
        "vfmadd231ps %%zmm14, %%zmm15, %%zmm0\n"
        "vfmadd231ps %%zmm14, %%zmm15, %%zmm1\n"
        "vfmadd231ps %%zmm14, %%zmm15, %%zmm2\n"
        "vfmadd231ps %%zmm14, %%zmm15, %%zmm3\n"
        "vfmadd231ps %%zmm14, %%zmm15, %%zmm4\n"
        "vfmadd231ps %%zmm14, %%zmm15, %%zmm5\n"
        "vfmadd231ps %%zmm14, %%zmm15, %%zmm6\n"
        "vfmadd231ps %%zmm14, %%zmm15, %%zmm7\n"
        "vfmadd231ps %%zmm14, %%zmm15, %%zmm8\n"
        "vfmadd231ps %%zmm14, %%zmm15, %%zmm9\n"
        "vfmadd231ps %%zmm14, %%zmm15, %%zmm10\n"
        "vfmadd231ps %%zmm14, %%zmm15, %%zmm11\n"
        "dec %0\n jnz 1b\n vzeroupper\n"
        : "+r"(rounds)::"cc", "xmm0", "xmm1", "xmm2", "xmm3", "xmm4", "xmm5", "xmm6", "xmm7",
          "xmm8", "xmm9", "xmm10", "xmm11", "xmm14", "xmm15");
}

void fp32_256(std::int64_t rounds) {
    asm volatile(
        "vpxor %%xmm0, %%xmm0, %%xmm0\n"
        "vpxor %%xmm1, %%xmm1, %%xmm1\n"
        "vpxor %%xmm2, %%xmm2, %%xmm2\n"
        "vpxor %%xmm3, %%xmm3, %%xmm3\n"
        "vpxor %%xmm4, %%xmm4, %%xmm4\n"
        "vpxor %%xmm5, %%xmm5, %%xmm5\n"
        "vpxor %%xmm6, %%xmm6, %%xmm6\n"
        "vpxor %%xmm7, %%xmm7, %%xmm7\n"
        "vpxor %%xmm8, %%xmm8, %%xmm8\n"
        "vpxor %%xmm9, %%xmm9, %%xmm9\n"
        "vpxor %%xmm10, %%xmm10, %%xmm10\n"
        "vpxor %%xmm11, %%xmm11, %%xmm11\n"
        "vpxor %%xmm14, %%xmm14, %%xmm14\n"
        "vpxor %%xmm15, %%xmm15, %%xmm15\n"
        "1:\n"
        "vfmadd231ps %%ymm14, %%ymm15, %%ymm0\n"
        "vfmadd231ps %%ymm14, %%ymm15, %%ymm1\n"
        "vfmadd231ps %%ymm14, %%ymm15, %%ymm2\n"
        "vfmadd231ps %%ymm14, %%ymm15, %%ymm3\n"
        "vfmadd231ps %%ymm14, %%ymm15, %%ymm4\n"
        "vfmadd231ps %%ymm14, %%ymm15, %%ymm5\n"
        "vfmadd231ps %%ymm14, %%ymm15, %%ymm6\n"
        "vfmadd231ps %%ymm14, %%ymm15, %%ymm7\n"
        "vfmadd231ps %%ymm14, %%ymm15, %%ymm8\n"
        "vfmadd231ps %%ymm14, %%ymm15, %%ymm9\n"
        "vfmadd231ps %%ymm14, %%ymm15, %%ymm10\n"
        "vfmadd231ps %%ymm14, %%ymm15, %%ymm11\n"
        "dec %0\n jnz 1b\n vzeroupper\n"
        : "+r"(rounds)::"cc", "xmm0", "xmm1", "xmm2", "xmm3", "xmm4", "xmm5", "xmm6", "xmm7",
          "xmm8", "xmm9", "xmm10", "xmm11", "xmm14", "xmm15");
}

void bf16(std::int64_t rounds) {
    asm volatile(
        "vpxor %%xmm0, %%xmm0, %%xmm0\n"
        "vpxor %%xmm1, %%xmm1, %%xmm1\n"
        "vpxor %%xmm2, %%xmm2, %%xmm2\n"
        "vpxor %%xmm3, %%xmm3, %%xmm3\n"
        "vpxor %%xmm4, %%xmm4, %%xmm4\n"
        "vpxor %%xmm5, %%xmm5, %%xmm5\n"
        "vpxor %%xmm6, %%xmm6, %%xmm6\n"
        "vpxor %%xmm7, %%xmm7, %%xmm7\n"
        "vpxor %%xmm8, %%xmm8, %%xmm8\n"
        "vpxor %%xmm9, %%xmm9, %%xmm9\n"
        "vpxor %%xmm10, %%xmm10, %%xmm10\n"
        "vpxor %%xmm11, %%xmm11, %%xmm11\n"
        "vpxor %%xmm14, %%xmm14, %%xmm14\n"
        "vpxor %%xmm15, %%xmm15, %%xmm15\n"
        "1:\n"
        "vdpbf16ps %%zmm14, %%zmm15, %%zmm0\n"
        "vdpbf16ps %%zmm14, %%zmm15, %%zmm1\n"
        "vdpbf16ps %%zmm14, %%zmm15, %%zmm2\n"
        "vdpbf16ps %%zmm14, %%zmm15, %%zmm3\n"
        "vdpbf16ps %%zmm14, %%zmm15, %%zmm4\n"
        "vdpbf16ps %%zmm14, %%zmm15, %%zmm5\n"
        "vdpbf16ps %%zmm14, %%zmm15, %%zmm6\n"
        "vdpbf16ps %%zmm14, %%zmm15, %%zmm7\n"
        "vdpbf16ps %%zmm14, %%zmm15, %%zmm8\n"
        "vdpbf16ps %%zmm14, %%zmm15, %%zmm9\n"
        "vdpbf16ps %%zmm14, %%zmm15, %%zmm10\n"
        "vdpbf16ps %%zmm14, %%zmm15, %%zmm11\n"
        "dec %0\n jnz 1b\n vzeroupper\n"
        : "+r"(rounds)::"cc", "xmm0", "xmm1", "xmm2", "xmm3", "xmm4", "xmm5", "xmm6", "xmm7",
          "xmm8", "xmm9", "xmm10", "xmm11", "xmm14", "xmm15");
}

void int8(std::int64_t rounds) {
    asm volatile(
        "vpxor %%xmm0, %%xmm0, %%xmm0\n"
        "vpxor %%xmm1, %%xmm1, %%xmm1\n"
        "vpxor %%xmm2, %%xmm2, %%xmm2\n"
        "vpxor %%xmm3, %%xmm3, %%xmm3\n"
        "vpxor %%xmm4, %%xmm4, %%xmm4\n"
        "vpxor %%xmm5, %%xmm5, %%xmm5\n"
        "vpxor %%xmm6, %%xmm6, %%xmm6\n"
        "vpxor %%xmm7, %%xmm7, %%xmm7\n"
        "vpxor %%xmm8, %%xmm8, %%xmm8\n"
        "vpxor %%xmm9, %%xmm9, %%xmm9\n"
        "vpxor %%xmm10, %%xmm10, %%xmm10\n"
        "vpxor %%xmm11, %%xmm11, %%xmm11\n"
        "vpxor %%xmm14, %%xmm14, %%xmm14\n"
        "vpxor %%xmm15, %%xmm15, %%xmm15\n"
        "1:\n"
        "vpdpbusd %%zmm14, %%zmm15, %%zmm0\n"
        "vpdpbusd %%zmm14, %%zmm15, %%zmm1\n"
        "vpdpbusd %%zmm14, %%zmm15, %%zmm2\n"
        "vpdpbusd %%zmm14, %%zmm15, %%zmm3\n"
        "vpdpbusd %%zmm14, %%zmm15, %%zmm4\n"
        "vpdpbusd %%zmm14, %%zmm15, %%zmm5\n"
        "vpdpbusd %%zmm14, %%zmm15, %%zmm6\n"
        "vpdpbusd %%zmm14, %%zmm15, %%zmm7\n"
        "vpdpbusd %%zmm14, %%zmm15, %%zmm8\n"
        "vpdpbusd %%zmm14, %%zmm15, %%zmm9\n"
        "vpdpbusd %%zmm14, %%zmm15, %%zmm10\n"
        "vpdpbusd %%zmm14, %%zmm15, %%zmm11\n"
        "dec %0\n jnz 1b\n vzeroupper\n"
        : "+r"(rounds)::"cc", "xmm0", "xmm1", "xmm2", "xmm3", "xmm4", "xmm5", "xmm6", "xmm7",
          "xmm8", "xmm9", "xmm10", "xmm11", "xmm14", "xmm15");
}

void int16(std::int64_t rounds) {
    asm volatile(
        "vpxor %%xmm0, %%xmm0, %%xmm0\n"
        "vpxor %%xmm1, %%xmm1, %%xmm1\n"
        "vpxor %%xmm2, %%xmm2, %%xmm2\n"
        "vpxor %%xmm3, %%xmm3, %%xmm3\n"
        "vpxor %%xmm4, %%xmm4, %%xmm4\n"
        "vpxor %%xmm5, %%xmm5, %%xmm5\n"
        "vpxor %%xmm6, %%xmm6, %%xmm6\n"
        "vpxor %%xmm7, %%xmm7, %%xmm7\n"
        "vpxor %%xmm8, %%xmm8, %%xmm8\n"
        "vpxor %%xmm9, %%xmm9, %%xmm9\n"
        "vpxor %%xmm10, %%xmm10, %%xmm10\n"
        "vpxor %%xmm11, %%xmm11, %%xmm11\n"
        "vpxor %%xmm14, %%xmm14, %%xmm14\n"
        "vpxor %%xmm15, %%xmm15, %%xmm15\n"
        "1:\n"
        "vpdpwssd %%zmm14, %%zmm15, %%zmm0\n"
        "vpdpwssd %%zmm14, %%zmm15, %%zmm1\n"
        "vpdpwssd %%zmm14, %%zmm15, %%zmm2\n"
        "vpdpwssd %%zmm14, %%zmm15, %%zmm3\n"
        "vpdpwssd %%zmm14, %%zmm15, %%zmm4\n"
        "vpdpwssd %%zmm14, %%zmm15, %%zmm5\n"
        "vpdpwssd %%zmm14, %%zmm15, %%zmm6\n"
        "vpdpwssd %%zmm14, %%zmm15, %%zmm7\n"
        "vpdpwssd %%zmm14, %%zmm15, %%zmm8\n"
        "vpdpwssd %%zmm14, %%zmm15, %%zmm9\n"
        "vpdpwssd %%zmm14, %%zmm15, %%zmm10\n"
        "vpdpwssd %%zmm14, %%zmm15, %%zmm11\n"
        "dec %0\n jnz 1b\n vzeroupper\n"
        : "+r"(rounds)::"cc", "xmm0", "xmm1", "xmm2", "xmm3", "xmm4", "xmm5", "xmm6", "xmm7",
          "xmm8", "xmm9", "xmm10", "xmm11", "xmm14", "xmm15");
}

struct Unit {
    void (*run)(std::int64_t rounds);
    int operations;  // of one instruction
};

bool has_vnni() {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vnni");
}

Unit unit_of(Precision precision) {
    switch (precision) {
        case Precision::fp32:
            if (__builtin_cpu_supports("avx512f")) return {fp32_512, 32};
            if (__builtin_cpu_supports("fma")) return {fp32_256, 16};
            return {};
        case Precision::bf16:
            return __builtin_cpu_supports("avx512bf16") ? Unit{bf16, 64} : Unit{};
        case Precision::int8:
            return has_vnni() ? Unit{int8, 128} : Unit{};
        case Precision::int16:
            return has_vnni() ? Unit{int16, 64} : Unit{};
    }
    return {};
}

#endif

}  // namespace

double run_multiply_adds(Precision precision, std::int64_t rounds) {
#if defined(__x86_64__)
    constexpr int chains = 12;
    const auto unit = unit_of(precision);
    if (unit.run == nullptr || rounds < 1) return 0;
    unit.run(rounds);
    return static_cast<double>(rounds) * chains * unit.operations;
#else
    static_cast<void>(precision);
    static_cast<void>(rounds);
    return 0;
#endif
}

}  // namespace nn
