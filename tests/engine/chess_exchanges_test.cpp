// Captures played out: what is won, what only seems to hang, and what the chances come to.
#include <gtest/gtest.h>

#include "engine/chess/exchanges.h"
#include "engine/chess/fen.h"

namespace chess {
namespace {

int settled(std::string_view fen) { return settled_material(position_from_fen(fen)); }

TEST(ChessExchanges, AQuietPositionIsItsMaterial) {
    EXPECT_EQ(settled_material(Position()), 0);
    EXPECT_EQ(settled("4k3/8/8/8/8/8/8/R3K3 w - - 0 1"), 500);
    EXPECT_EQ(settled("4k3/8/8/8/8/8/8/R3K3 b - - 0 1"), -500);
}

TEST(ChessExchanges, WhatHangsIsTaken) {
    EXPECT_EQ(settled("4k3/8/8/3q4/8/4N3/8/4K3 w - - 0 1"), 320);  // the queen for nothing
    // Guarded by a pawn: a knight for a queen.
    EXPECT_EQ(settled("4k3/8/2p5/3q4/8/4N3/8/4K3 w - - 0 1"), -100);
}

TEST(ChessExchanges, WhatIsGuardedIsLeftAlone) {
    EXPECT_EQ(settled("4k3/8/2p5/3p4/8/8/8/3QK3 w - - 0 1"), 700);
    // Two attackers on one guard: a pawn is won, whoever takes first.
    EXPECT_EQ(settled("3r2k1/8/8/3p4/8/3R4/3R4/6K1 w - - 0 1"), 500);
}

TEST(ChessExchanges, APawnPromotesAndMayCaptureInPassing) {
    EXPECT_EQ(settled("8/P3k3/8/8/8/8/8/4K3 w - - 0 1"), 900);
    EXPECT_EQ(settled("4k3/8/8/3pP3/8/8/8/4K3 w - d6 0 1"), 100);
}

TEST(ChessExchanges, OutOfCheckEveryMoveCountsAndMateIsLost) {
    // Nothing can be taken, but the king steps aside, and the rook is lost to the other's.
    EXPECT_EQ(settled("4r1k1/8/8/8/8/8/R7/4K3 w - - 0 1"), 0);
    EXPECT_LT(settled("6k1/8/8/8/8/8/5PPP/r5K1 w - - 0 1"), -100000);
    EXPECT_GT(settled("6k1/8/8/8/8/8/7q/K7 b - - 0 1"), 800);
}

TEST(ChessExchanges, ExpectationIsTheFirstPlayers) {
    engine::Random random(1);
    const auto expectation = [&](std::string_view fen) {
        const auto result = Exchanges().play(Chess::from_text(fen), random);
        EXPECT_EQ(result.outcome, Outcome::ongoing);
        return result.expectation;
    };
    EXPECT_NEAR(expectation("4k3/8/8/8/8/8/P7/4K3 w - - 0 1"), 0.32f, 0.01f);
    EXPECT_NEAR(expectation("4k3/8/8/8/8/8/P7/4K3 b - - 0 1"), 0.32f, 0.01f);
    EXPECT_LT(expectation("4kr2/8/8/8/8/8/P7/4K3 w - - 0 1"), -0.8f);
    const auto mate = Chess::from_text("R5k1/5ppp/8/8/8/8/8/4K3 b - - 0 1");
    EXPECT_EQ(Exchanges().play(mate, random).outcome, Outcome::first_wins);
}

TEST(ChessExchanges, CapturesAreTheLegalMovesThatTakeOrQueen) {
    engine::Random random(3);
    for (int games = 0; games < 40; ++games) {
        Position position;
        for (int ply = 0; ply < 160; ++ply) {
            const auto legal = position.legal_moves();
            if (legal.empty()) break;
            auto wanted = legal;
            wanted.filter([&](Move move) {
                if (kind_of(move) == MoveKind::promotion) return promoted_of(move) == Piece::queen;
                return kind_of(move) == MoveKind::en_passant ||
                       (kind_of(move) == MoveKind::normal && position.has(to_of(move)));
            });
            const auto captures = position.captures();
            ASSERT_EQ(captures.size(), wanted.size()) << fen(position);
            for (const Move move : captures) EXPECT_TRUE(wanted.contains(move)) << fen(position);
            position.play(legal[static_cast<int>(random.below(legal.size()))]);
        }
    }
}

}  // namespace
}  // namespace chess
