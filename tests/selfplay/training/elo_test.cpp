// Strengths from games, the ladder's arithmetic.
#include "selfplay/training/elo.h"

#include <gtest/gtest.h>

#include <cmath>

namespace selfplay::training {
namespace {

TEST(Elo, ManyGamesTellTheDifferenceAndItsError) {
    const Belief beliefs[] = {{0, 0}, {0, 1e6}};
    const Pairing games[] = {{1, 0, {750, 0, 250}}};
    const auto rated = strengths(beliefs, games);
    EXPECT_EQ(rated[0].elo, 0);
    EXPECT_NEAR(rated[1].elo, elo_of(0.75), 0.5);
    // The slope of the logistic at 75 %: one deviation of the score, sqrt(pq / n), over it.
    const double slope = 0.75 * 0.25 * std::log(10) / 400;
    EXPECT_NEAR(rated[1].deviation, std::sqrt(0.75 * 0.25 / 1000) / slope, 0.3);
}

TEST(Elo, PlayersAreComparedThroughOthers) {
    const Belief beliefs[] = {{0, 0}, {0, 1e6}, {0, 1e6}};
    const Pairing games[] = {{1, 0, {640, 0, 360}}, {2, 1, {640, 0, 360}}};
    const auto rated = strengths(beliefs, games);
    EXPECT_NEAR(rated[2].elo, 2 * elo_of(0.64), 1);
    EXPECT_GT(rated[2].deviation, rated[1].deviation);
}

TEST(Elo, ALoneSweepStaysFiniteAndNoGameLeavesTheBelief) {
    const Belief beliefs[] = {{0, 0}, {0, 400}, {250, 200}};
    const Pairing games[] = {{1, 0, {4, 0, 0}}};
    const auto rated = strengths(beliefs, games);
    EXPECT_GT(rated[1].elo, 100);
    EXPECT_LT(rated[1].elo, 800);
    EXPECT_NEAR(rated[2].elo, 250, 1e-6);
    EXPECT_NEAR(rated[2].deviation, 200, 1e-6);
    EXPECT_TRUE(strengths({}, {}).empty());
}

}  // namespace
}  // namespace selfplay::training
