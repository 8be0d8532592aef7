// Activation functions on vectors, good to about 1e-6. `Isa` is an instruction set as avx512.cpp
// has it. For the kernels; no standard library code.
#pragma once

#include "nn/winograd/kernels.h"

namespace nn::winograd {

// e^x by 2^n p(r), r within half of ln 2: Taylor's series, whose error there is under 2e-7.
template <class Isa, class Floats = typename Isa::Floats>
Floats exponential(Floats x) {
    x = Isa::minimum(Isa::maximum(x, Isa::set(-87)), Isa::set(88));
    const auto n = Isa::round(x * Isa::set(1.44269504f));
    const auto r =
        Isa::fused(n, Isa::set(2.12194440e-4f), Isa::fused(n, Isa::set(-0.693359375f), x));
    auto p = Isa::set(1.0f / 720);
    p = Isa::fused(p, r, Isa::set(1.0f / 120));
    p = Isa::fused(p, r, Isa::set(1.0f / 24));
    p = Isa::fused(p, r, Isa::set(1.0f / 6));
    p = Isa::fused(p, r, Isa::set(0.5f));
    p = Isa::fused(p, r, Isa::set(1));
    p = Isa::fused(p, r, Isa::set(1));
    return Isa::scale_by_power(p, n);
}

template <class Isa, class Floats = typename Isa::Floats>
Floats sigmoid(Floats x) {
    return Isa::set(1) / (Isa::set(1) + exponential<Isa>(Isa::set(0) - x));
}

// tanh(ln(1 + e^x)) is n / (n + 2) with n = e^x (e^x + 2); beyond 20 it is 1 and n overflows.
template <class Isa, class Floats = typename Isa::Floats>
Floats mish(Floats x) {
    const auto e = exponential<Isa>(Isa::minimum(x, Isa::set(20)));
    const auto n = e * (e + Isa::set(2));
    return x * n / (n + Isa::set(2));
}

template <class Isa, class Floats = typename Isa::Floats>
Floats curve(Curve kind, Floats x) {
    switch (kind) {
        case Curve::identity:
            return x;
        case Curve::relu:
            return Isa::maximum(x, Isa::set(0));
        case Curve::mish:
            return mish<Isa>(x);
        case Curve::silu:
            return x * sigmoid<Isa>(x);
        case Curve::tanh:
            return Isa::set(2) * sigmoid<Isa>(x + x) - Isa::set(1);
        case Curve::sigmoid:
            return sigmoid<Isa>(x);
        case Curve::square_root:
            return Isa::square_root(Isa::maximum(x, Isa::set(0)));
    }
    return x;
}

}  // namespace nn::winograd
