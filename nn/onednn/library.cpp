#include "nn/onednn/library.h"

#include <cstdlib>
#include <cstring>
#include <new>

// Declared here, since the header comes only with the compiler's own OpenMP.
extern "C" void omp_set_num_threads(int count);

namespace nn::onednn {

namespace {

constexpr std::size_t line = 64;

bool reaches(dnnl::cpu_isa wanted) {
    const auto have = static_cast<unsigned>(dnnl::get_effective_cpu_isa());
    const auto need = static_cast<unsigned>(wanted);
    return (have & need) == need;
}

}  // namespace

const dnnl::engine& processor() {
    static const dnnl::engine engine(dnnl::engine::kind::cpu, 0);
    return engine;
}

bool has_avx2() { return reaches(dnnl::cpu_isa::avx2); }
bool has_avx512() { return reaches(dnnl::cpu_isa::avx512_core); }
bool has_int8() { return reaches(dnnl::cpu_isa::avx512_core_vnni); }
bool has_bf16() { return reaches(dnnl::cpu_isa::avx512_core_bf16); }
bool has_tiles() { return reaches(dnnl::cpu_isa::avx512_core_amx); }

void use_callers_thread() { omp_set_num_threads(1); }

void Free::operator()(std::byte* bytes) const { std::free(bytes); }

Bytes allocate(std::size_t size) {
    // A line more: vector loads may run past the end.
    const auto rounded = (size + 2 * line - 1) / line * line;
    Bytes bytes(static_cast<std::byte*>(std::aligned_alloc(line, rounded)));
    if (!bytes) throw std::bad_alloc();
    std::memset(bytes.get(), 0, rounded);
    return bytes;
}

}  // namespace nn::onednn
