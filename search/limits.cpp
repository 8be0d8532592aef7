#include "search/limits.h"

#include <algorithm>
#include <cmath>

#include "search/analysis.h"

namespace search {

namespace {

// A value this much below what it was when the think began asks for more time.
constexpr float alarming_drop = 0.1f;
// Before this share of the soft time, the rate of simulations says little.
constexpr int least_share = 20;
// A move with so many times the visits of the next is clear enough to save time on.
constexpr std::uint64_t clear_lead = 4;

}  // namespace

std::uint64_t simulations_of_level(int level) {
    return static_cast<std::uint64_t>(std::lround(2 * std::pow(1.6, level)));
}

float temperature_of_level(int level) {
    return 1 - static_cast<float>(level) / static_cast<float>(full_level);
}

int level_of_elo(int elo) {
    return full_level * (elo - weakest_elo) / (strongest_elo - weakest_elo);
}

bool settled(const Standing& standing, std::uint64_t remaining) {
    return standing.moves <= 1 || standing.decided ||
           standing.first_visits > standing.second_visits + remaining;
}

Schedule::Schedule(const Limits& limits, const SearchParams& params, int moves_left,
                   Milliseconds lag) {
    if (limits.clock) {
        if (const auto allotted = allot(*limits.clock, moves_left, lag)) {
            soft_ = allotted->soft;
            hard_ = allotted->hard;
            saves_ = allotted->hard > allotted->soft;
            early_ = params.early_end;
        }
    }
    if (limits.time && (!hard_ || *limits.time <= *hard_)) {
        soft_ = hard_ = limits.time;
        saves_ = false;
        early_ = params.early_end_timed;
    }
}

bool Schedule::over(Milliseconds elapsed, std::uint64_t simulations, const Standing& standing,
                    std::optional<float> previous_value) {
    if (!hard_) return false;
    if (elapsed >= *hard_) return true;
    if (leader_ && *leader_ != standing.first) changed_ = elapsed;
    leader_ = standing.first;
    const bool at_rest = calm(elapsed, standing, previous_value);
    if (elapsed >= *soft_) return at_rest;
    if (!early_ || elapsed * least_share < *soft_) return false;
    if (standing.decided || standing.moves <= 1) return true;
    if (!at_rest) return false;
    const bool clear = standing.second_visits * clear_lead < standing.first_visits;
    if (saves_ && clear && elapsed >= *soft_ * 3 / 5) return true;
    const auto rate = static_cast<double>(simulations) /
                      static_cast<double>(std::max<std::int64_t>(elapsed.count(), 1));
    const auto to_come = rate * static_cast<double>((*soft_ - elapsed).count());
    return settled(standing, static_cast<std::uint64_t>(to_come));
}

// Whether more time is unlikely to change the move: it is the best valued, no worse than hoped for,
// and has been in front for a while.
bool Schedule::calm(Milliseconds elapsed, const Standing& standing,
                    std::optional<float> previous_value) const {
    const bool dropping = previous_value && standing.value < *previous_value - alarming_drop;
    const bool fresh = changed_ * 4 > elapsed * 3 && elapsed * 2 < *soft_ * 3;
    return standing.first_is_best && !dropping && !fresh;
}

}  // namespace search
