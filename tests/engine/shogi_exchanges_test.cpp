// Captures played out in shogi, where what is taken changes sides.
#include <gtest/gtest.h>

#include "engine/shogi/exchanges.h"
#include "engine/shogi/movegen.h"

namespace shogi {
namespace {

int settled(std::string_view sfen) { return settled_material(Shogi::from_text(sfen).position()); }

TEST(ShogiExchanges, AQuietPositionIsItsMaterialInHandToo) {
    EXPECT_EQ(settled_material(Position::start()), 0);
    EXPECT_EQ(settled("4k4/9/9/9/9/9/9/9/4K4 b G2p 1"), 540 - 180);
    EXPECT_EQ(settled("4k4/9/9/9/9/9/9/9/4K4 w G2p 1"), 180 - 540);
}

TEST(ShogiExchanges, WhatIsTakenCountsForBoth) {
    // A rook takes a silver that nobody guards: lost to one side, in the other's hand.
    EXPECT_EQ(settled("4k4/9/9/s8/9/9/R8/9/4K4 b - 1"), 990 + 495);
    // A lance guards it: the rook stays where it is.
    EXPECT_EQ(settled("l3k4/9/9/s8/9/9/R8/9/4K4 b - 1"), 990 - 495 - 315);
}

TEST(ShogiExchanges, PromotionIsAGain) {
    EXPECT_EQ(settled("4k4/9/9/P8/9/9/9/9/4K4 b - 1"), 540);
    EXPECT_EQ(settled("4k4/9/9/9/9/9/p8/9/4K4 b - 1"), -90);
}

TEST(ShogiExchanges, OutOfCheckEveryMoveCountsAndMateIsLost) {
    // The king takes the gold that checks it.
    EXPECT_EQ(settled("4k4/4G4/9/9/9/9/9/9/4K4 w - 1"), 540);
    EXPECT_LT(settled("4k4/4G4/4P4/9/9/9/9/9/4K4 w - 1"), -100000);
}

TEST(ShogiExchanges, ExpectationIsTheFirstPlayers) {
    engine::Random random(1);
    for (const char* mover : {"b", "w"}) {
        const auto sfen = fmt::format("4k4/9/9/9/9/9/9/9/4K4 {} R 1", mover);
        const auto result = Exchanges().play(Shogi::from_text(sfen), random);
        EXPECT_EQ(result.outcome, Outcome::ongoing);
        EXPECT_NEAR(result.expectation, 0.58f, 0.01f);
    }
}

TEST(ShogiExchanges, CapturesAreLegalMovesThatTakeOrPawnsThatPromote) {
    engine::Random random(3);
    for (int games = 0; games < 20; ++games) {
        Position position = Position::start();
        for (int ply = 0; ply < 200; ++ply) {
            const auto legal = legal_moves(position);
            if (legal.empty()) break;
            auto wanted = legal;
            wanted.filter([&](Move move) {
                if (is_drop(move)) return false;
                const Kind kind = position.at(from_square(move)).kind();
                if (position.at(to_square(move)).empty())
                    return kind == Kind::pawn && is_promotion(move);
                const Move promoting = board_move(from_square(move), to_square(move), true);
                return is_promotion(move) || !legal.contains(promoting);
            });
            const auto found = captures(position);
            ASSERT_EQ(found.size(), wanted.size());
            for (const Move move : found) EXPECT_TRUE(wanted.contains(move));
            position.play(legal[static_cast<int>(random.below(legal.size()))]);
        }
    }
}

}  // namespace
}  // namespace shogi
