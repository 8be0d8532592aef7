#include "search/limits.h"

#include <algorithm>

#include "search/analysis.h"

namespace search {

namespace {

// A value this much below what it was when the think began asks for more time.
constexpr float alarming_drop = 0.1f;
// Before this share of the soft time, the rate of simulations says little.
constexpr int least_share = 20;

}  // namespace

bool settled(const Standing& standing, std::uint64_t remaining) {
    return standing.moves <= 1 || standing.first_visits > standing.second_visits + remaining;
}

Schedule::Schedule(const Limits& limits, const SearchParams& params, int moves_left,
                   Milliseconds lag) {
    if (limits.clock) {
        if (const auto allotted = allot(*limits.clock, moves_left, lag)) {
            soft_ = allotted->soft;
            hard_ = allotted->hard;
            early_ = params.early_end;
        }
    }
    if (limits.time && (!hard_ || *limits.time <= *hard_)) {
        soft_ = hard_ = limits.time;
        early_ = params.early_end_timed;
    }
}

bool Schedule::over(Milliseconds elapsed, std::uint64_t simulations, const Standing& standing,
                    std::optional<float> previous_value) const {
    if (!hard_) return false;
    if (elapsed >= *hard_) return true;
    if (elapsed >= *soft_) {
        const bool dropping = previous_value && standing.value < *previous_value - alarming_drop;
        return standing.first_is_best && !dropping;
    }
    if (!early_ || elapsed * least_share < *soft_) return false;
    const auto rate = static_cast<double>(simulations) /
                      static_cast<double>(std::max<std::int64_t>(elapsed.count(), 1));
    const auto to_come = rate * static_cast<double>((*soft_ - elapsed).count());
    return settled(standing, static_cast<std::uint64_t>(to_come));
}

}  // namespace search
