#include "nn/onednn/kernel_loops.h"

namespace nn::onednn {

const Kernels& avx2_kernels() { return loops; }

}  // namespace nn::onednn
