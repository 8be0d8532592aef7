// Draws of other kinds than engine::Random and search/noise.h offer. Free functions on a generator
// that the caller owns.
#pragma once

#include <cstddef>
#include <span>

#include "engine/base/random.h"
#include "search/noise.h"

namespace selfplay::training {

inline bool happens(engine::Random& random, float share) {
    return search::open_unit(random) < static_cast<double>(share);
}

// An index in proportion to the weights, of which one at least is positive.
inline std::size_t draw(engine::Random& random, std::span<const float> weights) {
    double sum = 0;
    for (const float weight : weights) sum += static_cast<double>(weight);
    double left = search::open_unit(random) * sum;
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
