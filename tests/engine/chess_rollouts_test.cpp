#include <gtest/gtest.h>

#include "engine/chess/bench.h"
#include "engine/chess/rollouts.h"

namespace chess {
namespace {

TEST(ChessRollouts, AFinishedGameHasItsOwnResult) {
    engine::Random random(1);
    const Rollouts rollouts;
    const auto outcome = [&](std::string_view fen) {
        return rollouts.play(Chess::from_text(fen), random).outcome;
    };
    EXPECT_EQ(outcome("R5k1/5ppp/8/8/8/8/8/4K3 b - - 0 1"), Outcome::first_wins);
    EXPECT_EQ(outcome("7k/5Q2/6K1/8/8/8/8/8 b - - 0 1"), Outcome::draw);
    EXPECT_EQ(outcome("4k3/8/8/8/8/8/8/R3K3 w - - 100 80"), Outcome::draw);
}

TEST(ChessRollouts, ABareKingNeverWins) {
    engine::Random random(1);
    const auto game = Chess::from_text("8/8/8/8/8/1q6/k7/7K b - - 0 1");
    for (int i = 0; i < 50; ++i)
        EXPECT_NE(Rollouts().play(game, random).outcome, Outcome::first_wins);
}

// The share of wins agrees with play by the rules of a whole game, repetition and all.
TEST(ChessRollouts, AgreeWithPlayByTheFullRules) {
    engine::Random random(5);
    const auto game = Chess::from_text("4k3/8/8/8/8/8/8/Q3K2R w - - 0 1");
    const auto wins = [&](auto rollouts) {
        int count = 0;
        for (int i = 0; i < 1500; ++i)
            count += rollouts.play(game, random).outcome == Outcome::first_wins;
        return count;
    };
    EXPECT_NEAR(wins(Rollouts()), wins(engine::UniformRollouts<Chess>()), 120);
}

TEST(ChessBench, NamesItsFigures) {
    const auto figures = bench_rules(0.001);
    ASSERT_EQ(figures.size(), 3u);
    EXPECT_EQ(figures[0].name, "chess_perft");
    for (const auto& figure : figures) EXPECT_GT(figure.value, 0) << figure.name;
}

}  // namespace
}  // namespace chess
