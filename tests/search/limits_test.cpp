#include "search/limits.h"

#include <gtest/gtest.h>

#include "search/analysis.h"

using namespace std::chrono_literals;

namespace search {
namespace {

Limits clocked(Milliseconds main, Milliseconds period = 0ms) {
    Limits limits;
    TimeControl control;
    control.unlimited = false;
    control.main = main;
    control.period = period;
    control.periods = period > 0ms ? 1 : 0;
    limits.clock = TimeLeft::start_of(control);
    return limits;
}

// As two moves of many with these visits stand.
Standing race(std::uint64_t first, std::uint64_t second, std::uint16_t code = 1) {
    Standing standing;
    standing.first_visits = first;
    standing.second_visits = second;
    standing.first = Move{code};
    standing.moves = 30;
    return standing;
}

// When a think ends in which `at` says how things stand after so many milliseconds, with 1000
// simulations a second.
template <class At>
Milliseconds end_of(Schedule& schedule, At at) {
    Milliseconds elapsed{0};
    while (!schedule.over(elapsed, static_cast<std::uint64_t>(elapsed.count()), at(elapsed), {}))
        elapsed += 10ms;
    return elapsed;
}

struct Times {
    Milliseconds soft, hard;
};
Times times_of(const Limits& limits) {
    const auto allotted = *allot(*limits.clock, 30, 0ms);
    return {allotted.soft, allotted.hard};
}

TEST(Schedule, ACloseRaceTakesItsTime) {
    const auto limits = clocked(60s);
    Schedule schedule(limits, {}, 30, 0ms);
    const auto end = end_of(schedule, [](Milliseconds elapsed) {
        const auto n = static_cast<std::uint64_t>(elapsed.count());
        return race(n / 2 + 1, n / 2);
    });
    EXPECT_NEAR(static_cast<double>(end.count()),
                static_cast<double>(times_of(limits).soft.count()), 20);
}

TEST(Schedule, AClearLeaderSavesTime) {
    const auto limits = clocked(60s);
    Schedule schedule(limits, {}, 30, 0ms);
    const auto end = end_of(schedule, [](Milliseconds elapsed) {
        const auto n = static_cast<std::uint64_t>(elapsed.count());
        return race(n / 2, n / 10);
    });
    EXPECT_LT(end, times_of(limits).soft * 2 / 3);
}

TEST(Schedule, WhatCannotBeSavedIsUsed) {
    const auto limits = clocked(0s, 5s);
    Schedule schedule(limits, {}, 30, 0ms);
    const auto end = end_of(schedule, [](Milliseconds) { return race(3000, 500); });
    EXPECT_GT(end, times_of(limits).hard * 47 / 100);
}

TEST(Schedule, AMoveThatIsNotTheBestValuedTakesMore) {
    const auto limits = clocked(60s);
    Schedule schedule(limits, {}, 30, 0ms);
    const auto end = end_of(schedule, [](Milliseconds) {
        auto standing = race(1000, 900);
        standing.first_is_best = false;
        return standing;
    });
    EXPECT_GE(end, times_of(limits).hard);
}

TEST(Schedule, ANewLeaderIsGivenTimeToProveItself) {
    const auto limits = clocked(60s);
    const auto soft = times_of(limits).soft;
    Schedule schedule(limits, {}, 30, 0ms);
    const auto end = end_of(schedule, [&](Milliseconds elapsed) {
        const auto n = static_cast<std::uint64_t>(elapsed.count());
        return race(n / 2 + 1, n / 2, elapsed * 10 > soft * 9 ? 2 : 1);
    });
    EXPECT_GT(end, soft * 11 / 10);
    EXPECT_LT(end, soft * 8 / 5);
}

TEST(Schedule, WhatIsDecidedEndsAtOnce) {
    const auto limits = clocked(60s);
    Schedule schedule(limits, {}, 30, 0ms);
    const auto end = end_of(schedule, [](Milliseconds) {
        auto standing = race(100, 99);
        standing.decided = true;
        return standing;
    });
    EXPECT_LT(end, times_of(limits).soft / 10);
}

TEST(Schedule, AValueThatDropsTakesMore) {
    const auto limits = clocked(60s);
    Schedule schedule(limits, {}, 30, 0ms);
    const auto soft = times_of(limits).soft;
    auto standing = race(1000, 900);
    standing.value = -0.2f;
    EXPECT_FALSE(schedule.over(soft * 3 / 2, 1000, standing, 0.0f));
    EXPECT_TRUE(schedule.over(soft * 3 / 2, 1000, standing, -0.2f));
}

}  // namespace
}  // namespace search
