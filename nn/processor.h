// Which instructions our own kernels may use: those that the processor has, up to the limit that
// the environment variable ONEDNN_MAX_CPU_ISA sets. That name is oneDNN's, so that one word holds
// for the library and for us.
#pragma once

namespace nn {

bool may_use_avx2();         // with fused multiply-adds
bool may_use_avx512_vnni();  // and the F, BW, VL and DQ parts

}  // namespace nn
