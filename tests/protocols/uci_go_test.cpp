#include "protocols/uci_go.h"

#include <gtest/gtest.h>

namespace protocols {

using engine::Player;
using search::Milliseconds;

TEST(UciGo, ReadsClocksForBothColours) {
    const auto go = parse_go("wtime 1000 btime 2000 winc 10 binc 20 movestogo 5", true);
    EXPECT_EQ(go.time[0], Milliseconds(1000));
    EXPECT_EQ(go.time[1], Milliseconds(2000));
    const auto white = limits_of(go, Player::first), black = limits_of(go, Player::second);
    EXPECT_EQ(white.clock->main, Milliseconds(1000));
    EXPECT_EQ(white.clock->control.increment, Milliseconds(10));
    EXPECT_EQ(black.clock->main, Milliseconds(2000));
    EXPECT_EQ(black.clock->control.increment, Milliseconds(20));
    EXPECT_EQ(black.clock->moves, 5);
}

TEST(UciGo, InShogiBlackMovesFirst) {
    const auto go = parse_go("btime 1000 wtime 2000 byoyomi 500", false);
    const auto sente = limits_of(go, Player::first);
    EXPECT_EQ(sente.clock->main, Milliseconds(1000));
    EXPECT_EQ(sente.clock->control.period, Milliseconds(500));
    EXPECT_EQ(sente.clock->periods, 1);
}

TEST(UciGo, OneSidesTimeServesBoth) {
    const auto go = parse_go("wtime 100", true);
    EXPECT_EQ(limits_of(go, Player::second).clock->main, Milliseconds(100));
}

TEST(UciGo, NothingMeansEndless) {
    EXPECT_TRUE(limits_of(parse_go("", true), Player::first).endless());
    EXPECT_TRUE(limits_of(parse_go("infinite wtime 5", true), Player::first).endless());
}

TEST(UciGo, MovesEndAtTheNextKeyword) {
    const auto go = parse_go("searchmoves e2e4 d2d4 nodes 7 ponder", true);
    EXPECT_EQ(go.search_moves, (std::vector<std::string>{"e2e4", "d2d4"}));
    EXPECT_EQ(go.nodes, 7u);
    EXPECT_TRUE(go.ponder);
}

TEST(UciGo, BadNumbersAreBounded) {
    const auto go = parse_go("wtime -50 btime x winc 99999999999999999999 depth", true);
    EXPECT_EQ(go.time[0], Milliseconds(0));
    EXPECT_FALSE(go.time[1]);
    EXPECT_EQ(go.increment[0], Milliseconds(std::int64_t{7} * 24 * 3600 * 1000));
    EXPECT_FALSE(go.depth);
}

// Of a game of 1000 ms and 10 a move whose moves cost 30 ms beyond their thought of 20.
TEST(UciGo, TheClockTellsTheLag) {
    ClockLag lag;
    search::TimeLeft left;
    left.main = Milliseconds(1000);
    left.control.increment = Milliseconds(10);
    for (int move = 0; move < 20; ++move) {
        lag.shown(left);
        lag.answered(Milliseconds(20));
        left.main -= Milliseconds(40);
    }
    EXPECT_GE(lag.mean(), Milliseconds(28));
    EXPECT_LE(lag.mean(), Milliseconds(30));
    const auto before = lag.mean();
    EXPECT_EQ(lag.without_lag(left).main, left.main - before);
    EXPECT_EQ(lag.without_lag(left).control.increment, Milliseconds(10) - before);
    left.main = Milliseconds(0);
    EXPECT_EQ(lag.without_lag(left).main, Milliseconds(0));
}

TEST(UciGo, AnotherGameTellsNoLag) {
    ClockLag lag;
    search::TimeLeft left;
    left.main = Milliseconds(60000);
    lag.shown(left);
    lag.answered(Milliseconds(20));
    left.main = Milliseconds(30000);
    lag.shown(left);
    left.main = Milliseconds(29000);
    lag.shown(left);  // the move before was not answered
    lag.answered(Milliseconds(0));
    lag.forget_game();
    left.main = Milliseconds(28000);
    lag.shown(left);
    EXPECT_EQ(lag.mean(), Milliseconds(0));
}

TEST(UciGo, MateTakesInfinite) {
    EXPECT_EQ(parse_go("mate infinite", false).mate, ~std::uint64_t{0});
    EXPECT_EQ(parse_go("mate 3000", false).mate, 3000u);
}

}  // namespace protocols
