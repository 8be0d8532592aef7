// Draws of other kinds than engine::Random offers. Free functions on a generator that the caller
// owns; the same on every machine for equal seeds, the normal one up to the last bits of libm.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include "engine/base/random.h"

namespace selfplay::training {

// In [0, 1).
inline double uniform(engine::Random& random) {
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

inline bool happens(engine::Random& random, float share) {
    return uniform(random) < static_cast<double>(share);
}

// Of mean 0 and deviation 1 (Box and Muller 1958).
inline double normal(engine::Random& random) {
    const double radius = std::sqrt(-2 * std::log(1 - uniform(random)));
    return radius * std::cos(2 * std::numbers::pi * uniform(random));
}

// An index in proportion to the weights, of which one at least is positive.
inline std::size_t draw(engine::Random& random, std::span<const float> weights) {
    double sum = 0;
    for (const float weight : weights) sum += static_cast<double>(weight);
    double left = uniform(random) * sum;
    std::size_t last = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        if (weights[i] <= 0) continue;
        last = i;
        left -= static_cast<double>(weights[i]);
        if (left < 0) break;
    }
    return last;
}

}  // namespace selfplay::training
