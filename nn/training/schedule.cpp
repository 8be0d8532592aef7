#include "nn/training/schedule.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nn::training {

float Schedule::at(std::int64_t steps, std::int64_t updates) const {
    float now = rate;
    for (const auto& [step, lower] : drops)
        if (steps >= step) now = lower;
    if (cosine_steps > 0) {
        const double done = std::min(1.0, double(steps) / double(cosine_steps));
        const double height = (1 + std::cos(std::numbers::pi * done)) / 2;
        now = static_cast<float>(last_rate + (now - last_rate) * height);
    }
    if (updates < warm_up) now *= static_cast<float>(updates + 1) / static_cast<float>(warm_up);
    return now;
}

}  // namespace nn::training
