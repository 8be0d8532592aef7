#include "selfplay/training/replay_settings.h"

#include <algorithm>
#include <cmath>

namespace selfplay::training {

std::size_t window_of(const ReplaySettings& settings, std::uint64_t games) {
    const double first = settings.window, exponent = double{settings.window_exponent};
    const double ratio = std::max(1.0, static_cast<double>(games) / first);
    const double growth =
        double{settings.window_factor} * (std::pow(ratio, exponent) - 1) / exponent;
    return static_cast<std::size_t>(first * (1 + growth));
}

}  // namespace selfplay::training
