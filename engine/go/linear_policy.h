// The weights of AlphaGo's two linear policies, the rollouts' and the tree's: a logit for every
// feature of move_features.h. Values, shared read-only by any thread.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/go/move_features.h"

namespace go {

// A policy made ready for play: the exponential of each logit.
class Factors {
   public:
    // One logit a feature.
    explicit Factors(const std::vector<float>& logits);

    float operator[](int feature) const { return factors_[static_cast<std::size_t>(feature)]; }
    // Of the pattern with such surroundings (RolloutBoard).
    float of_pattern(std::uint16_t surroundings, Colour mover) const {
        return patterns_[mover == Colour::black ? 0 : 1][surroundings];
    }

    // A product of factors as a whole number, so that sums of them stay exact: 1/4096 at least,
    // 1024 at most, in parts of 4096.
    static std::uint32_t weight(float product) {
        constexpr float unit = 4096, most = 1024;
        return static_cast<std::uint32_t>(std::clamp(product, 1 / unit, most) * unit);
    }

   private:
    std::vector<float> factors_;
    std::array<std::vector<float>, 2> patterns_;
};

struct LinearPolicies {
    Factors rollout, tree;
};

}  // namespace go
