#include "nn/peak.h"

#include <array>

#include "engine/base/measure.h"

#if defined(__x86_64__) && defined(__linux__)
#include <cpuid.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

namespace nn {

namespace {

#if defined(__x86_64__)

// One instruction a multiply-add, but for int16 in AVX2: a product of pairs and a sum.
enum class Unit : int {
    none,
    fp32_256,
    fp32_512,
    bf16_512,
    int8_512,
    int16_256,
    int16_512,
    bf16_tiles,
    int8_tiles
};

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

// AMX: products of tiles, 16 rows of 64 bytes each, in six chains twice a round.
template <Unit unit>
void run_tiles(std::int64_t rounds) {
    struct Config {
        std::uint8_t palette = 1, start = 0;
        std::array<std::uint8_t, 14> reserved = {};
        std::array<std::uint16_t, 16> row_bytes = {64, 64, 64, 64, 64, 64, 64, 64};
        std::array<std::uint8_t, 16> rows = {16, 16, 16, 16, 16, 16, 16, 16};
    };
    const Config config;
    asm volatile(
        "ldtilecfg %1\n"
        ".irp r, 0, 1, 2, 3, 4, 5, 6, 7\n tilezero %%tmm\\r\n .endr\n"
        "1:\n"
        ".irp r, 0, 1, 2, 3, 4, 5, 0, 1, 2, 3, 4, 5\n"
        ".if %c2 == 7\n tdpbf16ps %%tmm7, %%tmm6, %%tmm\\r\n .endif\n"
        ".if %c2 == 8\n tdpbusd %%tmm7, %%tmm6, %%tmm\\r\n .endif\n"
        ".endr\n"
        "dec %0\n jnz 1b\n tilerelease\n"
        : "+r"(rounds)
        : "m"(config), "i"(static_cast<int>(unit))
        : "cc");
}

// The kernel wants to be asked before a process uses tiles (Linux,
// Documentation/arch/x86/xstate.rst).
bool has_tiles([[maybe_unused]] unsigned format_bit) {
#if defined(__linux__)
    constexpr unsigned tile_bit = 1U << 24;
    const unsigned wanted = tile_bit | format_bit;
    unsigned a = 0, b = 0, c = 0, d = 0;
    if (!__get_cpuid_count(7, 0, &a, &b, &c, &d) || (d & wanted) != wanted) return false;
    constexpr long request = 0x1023, tile_data = 18;
    static const bool granted = syscall(SYS_arch_prctl, request, tile_data) == 0;
    return granted;
#else
    return false;
#endif
}

bool has_vnni() {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vnni");
}

Unit unit_for(Precision precision) {
    constexpr unsigned bf16_bit = 1U << 22, int8_bit = 1U << 25;
    switch (precision) {
        case Precision::fp32:
            if (__builtin_cpu_supports("avx512f")) return Unit::fp32_512;
            return __builtin_cpu_supports("fma") ? Unit::fp32_256 : Unit::none;
        case Precision::bf16:
            if (has_tiles(bf16_bit)) return Unit::bf16_tiles;
            return __builtin_cpu_supports("avx512bf16") ? Unit::bf16_512 : Unit::none;
        case Precision::int8:
            if (has_tiles(int8_bit)) return Unit::int8_tiles;
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
        case Unit::bf16_tiles:
            return run_tiles<Unit::bf16_tiles>(rounds), 2 * 16 * 16 * 32;
        case Unit::int8_tiles:
            return run_tiles<Unit::int8_tiles>(rounds), 2 * 16 * 16 * 64;
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

double peak_rate(Precision precision, double seconds) {
    constexpr std::int64_t rounds = 10000;
    double operations = 0;
    const double calls = engine::calls_per_second(
        seconds, [&] { operations = run_multiply_adds(precision, rounds); }, 1);
    return calls * operations;
}

}  // namespace nn
