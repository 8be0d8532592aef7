#include "nn/peak.h"

namespace nn {

namespace {

#if defined(__x86_64__)

// One instruction a multiply-add, but for int16 in AVX2: a product of pairs and a sum.
enum class Unit : int { none, fp32_256, fp32_512, bf16_512, int8_512, int16_256, int16_512 };

constexpr int chains = 12;  // enough to hide an instruction's latency

// Twelve chains, `rounds` times. Assembly, since a compiler drops what has no result; the assembler
// takes the instruction by the unit's number.
template <Unit unit>
void run_chains(std::int64_t rounds) {
    asm volatile(
        ".irp r, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14\n"
        "vpxor %%xmm\\r, %%xmm\\r, %%xmm\\r\n"
        ".endr\n"
        "1:\n"
        ".irp r, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11\n"
        ".if %c1 == 1\n vfmadd231ps %%ymm13, %%ymm14, %%ymm\\r\n .endif\n"
        ".if %c1 == 2\n vfmadd231ps %%zmm13, %%zmm14, %%zmm\\r\n .endif\n"
        ".if %c1 == 3\n vdpbf16ps %%zmm13, %%zmm14, %%zmm\\r\n .endif\n"
        ".if %c1 == 4\n vpdpbusd %%zmm13, %%zmm14, %%zmm\\r\n .endif\n"
        ".if %c1 == 5\n vpmaddwd %%ymm13, %%ymm14, %%ymm12\n"
        "vpaddd %%ymm12, %%ymm\\r, %%ymm\\r\n .endif\n"
        ".if %c1 == 6\n vpdpwssd %%zmm13, %%zmm14, %%zmm\\r\n .endif\n"
        ".endr\n"
        "dec %0\n jnz 1b\n vzeroupper\n"
        : "+r"(rounds)
        : "i"(static_cast<int>(unit))
        : "cc", "xmm0", "xmm1", "xmm2", "xmm3", "xmm4", "xmm5", "xmm6", "xmm7", "xmm8", "xmm9",
          "xmm10", "xmm11", "xmm12", "xmm13", "xmm14");
}

bool has_vnni() {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vnni");
}

Unit unit_for(Precision precision) {
    switch (precision) {
        case Precision::fp32:
            if (__builtin_cpu_supports("avx512f")) return Unit::fp32_512;
            return __builtin_cpu_supports("fma") ? Unit::fp32_256 : Unit::none;
        case Precision::bf16:
            return __builtin_cpu_supports("avx512bf16") ? Unit::bf16_512 : Unit::none;
        case Precision::int8:
            return has_vnni() ? Unit::int8_512 : Unit::none;
        case Precision::int16:
            if (has_vnni()) return Unit::int16_512;
            return __builtin_cpu_supports("avx2") ? Unit::int16_256 : Unit::none;
    }
    return Unit::none;
}

// Yields how many operations one multiply-add of the unit is.
int run(Unit unit, std::int64_t rounds) {
    switch (unit) {
        case Unit::fp32_256:
            return run_chains<Unit::fp32_256>(rounds), 16;
        case Unit::fp32_512:
            return run_chains<Unit::fp32_512>(rounds), 32;
        case Unit::bf16_512:
            return run_chains<Unit::bf16_512>(rounds), 64;
        case Unit::int8_512:
            return run_chains<Unit::int8_512>(rounds), 128;
        case Unit::int16_256:
            return run_chains<Unit::int16_256>(rounds), 32;
        case Unit::int16_512:
            return run_chains<Unit::int16_512>(rounds), 64;
        case Unit::none:
            break;
    }
    return 0;
}

#endif

}  // namespace

double run_multiply_adds([[maybe_unused]] Precision precision,
                         [[maybe_unused]] std::int64_t rounds) {
#if defined(__x86_64__)
    if (rounds > 0) return static_cast<double>(rounds) * chains * run(unit_for(precision), rounds);
#endif
    return 0;
}

}  // namespace nn
