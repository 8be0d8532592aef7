#include "nn/onednn/kernels.h"

#include "nn/onednn/library.h"

namespace nn::onednn {

const Kernels& kernels() {
    if (has_avx512()) return avx512_kernels();
    return has_avx2() ? avx2_kernels() : baseline_kernels();
}

}  // namespace nn::onednn
