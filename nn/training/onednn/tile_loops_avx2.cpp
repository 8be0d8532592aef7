// Compiled for AVX2 with FMA; called only where the processor has both.
#include "nn/training/onednn/tile_loops_body.h"

namespace nn::training {

namespace {

struct Avx2 {
    using Vector = float __attribute__((vector_size(32)));
    static constexpr int most = 6;
};

}  // namespace

constinit const TileLoops avx2_tile_loops = TileLoopsBody<Avx2>::table();

}  // namespace nn::training
