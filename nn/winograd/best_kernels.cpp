#include "nn/processor.h"
#include "nn/winograd/kernels.h"

namespace nn::winograd {

const Kernels* best_kernels() {
#if defined(__x86_64__)
    if (may_use_avx512_vnni()) return avx512_kernels();
    if (may_use_avx2()) return avx2_kernels();
#endif
    return nullptr;
}

}  // namespace nn::winograd
