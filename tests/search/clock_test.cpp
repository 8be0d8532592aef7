#include "search/clock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "engine/base/random.h"

namespace search {
namespace {

using namespace std::chrono_literals;

TimeControl absolute(Milliseconds main) {
    TimeControl control;
    control.unlimited = false;
    control.main = main;
    return control;
}

TimeControl fischer(Milliseconds main, Milliseconds increment) {
    auto control = absolute(main);
    control.increment = increment;
    return control;
}

TimeControl overtime(Milliseconds main, Milliseconds period, int periods, int moves) {
    auto control = absolute(main);
    control.period = period;
    control.periods = periods;
    control.period_moves = moves;
    return control;
}

TimeControl session(Milliseconds main, int moves) {
    auto control = absolute(main);
    control.moves_per_session = moves;
    return control;
}

TEST(TimeLeft, AbsoluteTimeRunsOut) {
    auto left = TimeLeft::start_of(absolute(10s));
    EXPECT_EQ(left.longest_move(), 10s);
    EXPECT_TRUE(left.spend(4s));
    EXPECT_EQ(left.main, 6s);
    EXPECT_TRUE(left.spend(6s));
    EXPECT_FALSE(left.spend(1ms));
}

TEST(TimeLeft, FischerAddsAfterTheMove) {
    auto left = TimeLeft::start_of(fischer(10s, 2s));
    EXPECT_FALSE(TimeLeft(left).spend(11s));
    EXPECT_TRUE(left.spend(9s));
    EXPECT_EQ(left.main, 3s);
}

TEST(TimeLeft, JapanesePeriodsComeBackUnlessExceeded) {
    auto left = TimeLeft::start_of(overtime(5s, 10s, 3, 1));
    EXPECT_EQ(left.longest_move(), 35s);
    EXPECT_TRUE(left.spend(14s));  // 5 s of main time, 9 s of the first period
    EXPECT_TRUE(left.in_overtime());
    EXPECT_EQ(left.periods, 3);
    EXPECT_EQ(left.period, 10s);
    EXPECT_TRUE(left.spend(10s));
    EXPECT_EQ(left.periods, 3);
    EXPECT_TRUE(left.spend(25s));
    EXPECT_EQ(left.periods, 1);
    EXPECT_EQ(left.longest_move(), 10s);
    EXPECT_FALSE(left.spend(10001ms));
}

TEST(TimeLeft, CanadianPeriodsLastForTheirMoves) {
    auto left = TimeLeft::start_of(overtime(0s, 10s, 1, 3));
    EXPECT_TRUE(left.in_overtime());
    EXPECT_TRUE(left.spend(4s));
    EXPECT_EQ(left.period, 6s);
    EXPECT_EQ(left.moves, 2);
    EXPECT_FALSE(TimeLeft(left).spend(7s));
    EXPECT_TRUE(left.spend(5s));
    EXPECT_TRUE(left.spend(1s));
    EXPECT_EQ(left.period, 10s);
    EXPECT_EQ(left.moves, 3);
}

TEST(TimeLeft, ASessionRefillsTheMainTime) {
    auto left = TimeLeft::start_of(session(10s, 2));
    EXPECT_TRUE(left.spend(3s));
    EXPECT_EQ(left.moves, 1);
    EXPECT_TRUE(left.spend(3s));
    EXPECT_EQ(left.main, 14s);
    EXPECT_EQ(left.moves, 2);
}

TEST(TimeLeft, UnlimitedTimeIsNeverLost) {
    auto left = TimeLeft::start_of({});
    EXPECT_TRUE(left.spend(1000h));
    EXPECT_FALSE(allot(left, 30, 0ms));
}

struct Case {
    std::string name;
    TimeControl control;
    double least_use;  // share of the time that a game of 60 moves could use
};

void PrintTo(const Case& control, std::ostream* out) { *out << control.name; }

const std::vector<Case> cases = {
    {"absolute 2 s", absolute(2s), 0.5},
    {"absolute 10 min", absolute(600s), 0.6},
    {"Fischer 1 s + 10 ms", fischer(1s, 10ms), 0.5},
    {"Fischer 60 s + 5 s", fischer(60s, 5s), 0.6},
    {"Fischer 0 s + 1 s", fischer(1s, 1s), 0.5},
    {"byo-yomi 5 x 1 s", overtime(0s, 1s, 5, 1), 0.85},
    {"byo-yomi 60 s + 1 x 10 s", overtime(60s, 10s, 1, 1), 0.8},
    {"byo-yomi 10 min + 3 x 30 s", overtime(600s, 30s, 3, 1), 0.7},
    {"Canadian 10 s for 10", overtime(0s, 10s, 1, 10), 0.6},
    {"Canadian 60 s + 20 s for 25", overtime(60s, 20s, 1, 25), 0.55},
    {"Canadian 1 s for 25", overtime(0s, 1s, 1, 25), 0.2},
    {"40 moves in 60 s", session(60s, 40), 0.6},
    {"10 moves in 1 s", session(1s, 10), 0.4},
};

// What the control gives for `moves` moves if none is wasted.
Milliseconds given(const TimeControl& control, int moves) {
    const int sessions = control.moves_per_session
                             ? (moves + control.moves_per_session - 1) / control.moves_per_session
                             : 1;
    auto time = control.main * sessions + control.increment * moves;
    if (control.periods > 0) time += control.period * moves / control.period_moves;
    return time;
}

class WholeGame : public testing::TestWithParam<Case> {};

// Thinks of any length between soft and hard, and a lag of up to what is kept back, never lose.
TEST_P(WholeGame, LosesNoTime) {
    constexpr int lag = 15;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        engine::Random random(seed);
        auto left = TimeLeft::start_of(GetParam().control);
        for (int move = 0; move < 150; ++move) {
            const auto time = allot(left, std::max(60 - move, 10), Milliseconds(lag));
            ASSERT_TRUE(time);
            ASSERT_GE(time->soft, 1ms);
            ASSERT_LE(time->soft, time->hard);
            const auto extra = static_cast<int>((time->hard - time->soft).count()) + 1;
            const auto used = time->soft + Milliseconds(random.below(extra) + random.below(lag));
            // Below the lag itself nothing can be promised.
            if (left.longest_move() <= Milliseconds(2 * lag)) break;
            ASSERT_TRUE(left.spend(used)) << "move " << move << " took " << used.count() << " ms";
        }
    }
}

// Thinks that keep to the soft time use the greater part of what there is.
TEST_P(WholeGame, WastesLittle) {
    auto left = TimeLeft::start_of(GetParam().control);
    Milliseconds used{0};
    for (int move = 0; move < 60; ++move) {
        const auto time = allot(left, 60 - move, 10ms);
        used += time->soft;
        ASSERT_TRUE(left.spend(time->soft + 5ms));
    }
    EXPECT_GE(static_cast<double>(used.count()),
              GetParam().least_use * static_cast<double>(given(GetParam().control, 60).count()));
}

// However the search ends each think, a game of 120 moves must not run into its last moments.
TEST_P(WholeGame, KeepsTimeForALongGame) {
    auto left = TimeLeft::start_of(GetParam().control);
    for (int move = 0; move < 120; ++move) {
        const auto time = allot(left, std::max(60 - move, 20), 5ms);
        ASSERT_TRUE(left.spend(std::min(time->soft + 2ms, left.longest_move()))) << move;
    }
}

INSTANTIATE_TEST_SUITE_P(Controls, WholeGame, testing::ValuesIn(cases),
                         [](const auto& test) { return "Case" + std::to_string(test.index); });

TEST(Allot, IsSaneWithNothingLeft) {
    for (auto control : {absolute(10s), fischer(10s, 100ms), session(10s, 40)}) {
        auto left = TimeLeft::start_of(control);
        for (const auto main : {0ms, 1ms, 5ms, 20ms}) {
            left.main = main;
            const auto time = allot(left, 30, 20ms);
            EXPECT_GE(time->soft, 1ms);
            EXPECT_LE(time->hard, std::max(main, 1ms));
        }
    }
}

TEST(Allot, NeverExceedsTheLongestMove) {
    engine::Random random(7);
    for (const auto& [name, control, use] : cases) {
        for (int i = 0; i < 1000; ++i) {
            auto left = TimeLeft::start_of(control);
            left.main = Milliseconds(random.below(1 + static_cast<int>(left.main.count())));
            left.period = Milliseconds(random.below(1 + static_cast<int>(left.period.count())));
            const auto time = allot(left, 1 + random.below(100), Milliseconds(random.below(50)));
            EXPECT_LE(time->hard, std::max(left.longest_move(), 1ms)) << name;
        }
    }
}

TEST(Allot, KeepsPartOfByoYomiBack) {
    const auto hard = [](Milliseconds period, Milliseconds lag) {
        return allot(TimeLeft::start_of(overtime(0s, period, 1, 1)), 30, lag)->hard;
    };
    EXPECT_EQ(hard(1s, 20ms), 800ms);
    EXPECT_EQ(hard(1s, 220ms), 780ms);
    EXPECT_EQ(hard(200ms, 5ms), 160ms);
    EXPECT_EQ(hard(10s, 20ms), 9700ms);
}

TEST(Allot, KeepsLessOfAMoveTimeBack) {
    EXPECT_EQ(move_within(500ms, 20ms), 450ms);
    EXPECT_EQ(move_within(100ms, 20ms), 80ms);
    EXPECT_EQ(move_within(10s, 20ms), 9700ms);
}

TEST(LagMeter, RemembersTheGreatestAndForgetsSlowly) {
    LagMeter meter;
    EXPECT_EQ(meter.reserve(), 0ms);
    meter.record(40ms);
    meter.record(2ms);
    EXPECT_GE(meter.reserve(), 4 * 37ms);
    for (int i = 0; i < 200; ++i) meter.record(2ms);
    EXPECT_LE(meter.reserve(), 4 * 3ms);
    EXPECT_EQ(LagMeter::reserve_for(10ms), 40ms);
}

}  // namespace
}  // namespace search
