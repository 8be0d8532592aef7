#include "selfplay/training/actor_settings.h"

#include <cmath>

#include "engine/base/error.h"

namespace selfplay::training {

void check(const ActorSettings& settings) {
    if (settings.full_share < 1 && settings.fast_simulations > settings.simulations)
        engine::fail("fast-simulations ({}) must not exceed simulations ({})",
                     settings.fast_simulations, settings.simulations);
    if (settings.least_size > settings.size)
        engine::fail("least-size ({}) must not exceed size ({})", settings.least_size,
                     settings.size);
    if (settings.least_size == 1) engine::fail("least-size must be 0 or at least 2, not 1");
    if (std::floor(settings.komi * 2) != settings.komi * 2)
        engine::fail("komi must be a multiple of 0.5, not {}", settings.komi);
}

}  // namespace selfplay::training
