// Compiled for AVX-512; called only where the processor has it.
#include "nn/training/onednn/loops_body.h"

namespace nn::training {

namespace {

struct Avx512;

}  // namespace

extern constinit const Loops<float> avx512_loops;
extern constinit const Loops<Bf16> avx512_bf16_loops;
constinit const Loops<float> avx512_loops = LoopsBody<Avx512, float>::table();
constinit const Loops<Bf16> avx512_bf16_loops = LoopsBody<Avx512, Bf16>::table();

}  // namespace nn::training
