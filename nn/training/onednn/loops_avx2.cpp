// Compiled for AVX2 with FMA; called only where the processor has both.
#include "nn/training/onednn/loops_body.h"

namespace nn::training {

namespace {

struct Avx2;

}  // namespace

extern constinit const Loops<float> avx2_loops;
constinit const Loops<float> avx2_loops = LoopsBody<Avx2, float>::table();

}  // namespace nn::training
