#include "nn/onednn/kernel_loops.h"

namespace nn::onednn {

const Kernels& baseline_kernels() { return loops; }

}  // namespace nn::onednn
