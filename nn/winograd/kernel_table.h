// The table of kernels of an instruction set. For the kernels; no standard library code.
#pragma once

#include "nn/winograd/small_kernels.h"
#include "nn/winograd/tower_kernels.h"

namespace nn::winograd {

template <class Isa>
constexpr Kernels kernels_of(const char* name, int width) {
    return {name,          width,        transform<Isa>, multiply<Isa>, finish<Isa>,
            points<Isa>,   first<Isa>,   pointwise<Isa>, pool<Isa>,     dense<Isa>,
            activate<Isa>, nonzero<Isa>, peak<Isa>};
}

}  // namespace nn::winograd
