#include "nn/processor.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <string_view>

namespace nn {

namespace {

// oneDNN's names of instruction sets, those before AVX2 and those before AVX-512 with VNNI.
constexpr std::array<std::string_view, 2> below_avx2 = {"SSE41", "AVX"};
constexpr std::array<std::string_view, 5> below_vnni = {"AVX2", "AVX2_VNNI", "AVX512_MIC",
                                                        "AVX512_MIC_4OPS", "AVX512_CORE"};

std::string limit() {
    const char* set = std::getenv("ONEDNN_MAX_CPU_ISA");
    std::string name(set ? set : "");
    std::transform(name.begin(), name.end(), name.begin(),
                   [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
    return name;
}

template <std::size_t count>
bool among(const std::array<std::string_view, count>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

#if defined(__x86_64__)

bool may_use_avx2() {
    return !among(below_avx2, limit()) && __builtin_cpu_supports("avx2") &&
           __builtin_cpu_supports("fma");
}

bool may_use_avx512_vnni() {
    return may_use_avx2() && !among(below_vnni, limit()) && __builtin_cpu_supports("avx512f") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vnni");
}

#else

bool may_use_avx2() { return false; }
bool may_use_avx512_vnni() { return false; }

#endif

}  // namespace nn
