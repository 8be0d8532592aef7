#include "nn/onednn/kernel_loops.h"

namespace nn::onednn {

const Kernels& avx512_kernels() { return loops; }

}  // namespace nn::onednn
