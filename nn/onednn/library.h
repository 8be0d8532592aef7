// oneDNN as this folder uses it: one engine for the process, and what the processor may be asked
// for. The limit that the library itself knows (ONEDNN_MAX_CPU_ISA) holds for our loops as well.
#pragma once

#include <cstddef>
#include <dnnl.hpp>
#include <memory>

namespace nn::onednn {

const dnnl::engine& processor();

bool has_avx2();
bool has_avx512();
bool has_int8();  // VNNI
bool has_bf16();
bool has_tiles();  // AMX, of bf16 and int8

// The library's own threads are none of ours: everything runs on the caller's.
void use_callers_thread();

struct Free {
    void operator()(std::byte* bytes) const;
};
using Bytes = std::unique_ptr<std::byte, Free>;
// Aligned to cache lines, zeroed.
Bytes allocate(std::size_t size);

}  // namespace nn::onednn
