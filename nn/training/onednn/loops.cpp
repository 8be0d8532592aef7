#include "nn/onednn/library.h"
#include "nn/training/onednn/loops_body.h"

namespace nn::training {

extern const Loops<float> avx2_loops, avx512_loops;
extern const Loops<Bf16> avx512_bf16_loops;

namespace {

struct Portable;

}  // namespace

template <>
const Loops<float>& loops<float>() {
    static constexpr auto portable = LoopsBody<Portable, float>::table();
    if (onednn::has_avx512()) return avx512_loops;
    return onednn::has_avx2() ? avx2_loops : portable;
}

template <>
const Loops<Bf16>& loops<Bf16>() {
    static constexpr auto portable = LoopsBody<Portable, Bf16>::table();
    return onednn::has_avx512() ? avx512_bf16_loops : portable;
}

}  // namespace nn::training
