// Positions as text: what is read, what is written, and what is refused and why.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/error.h"
#include "engine/chess/chess.h"
#include "engine/chess/fen.h"

namespace chess {
namespace {

constexpr auto start_fen = "rnbqkbnr/pppppppp/8/8/8/8/PPPPPPPP/RNBQKBNR w KQkq - 0 1";

std::string reread(std::string_view text) { return fen(position_from_fen(text)); }

std::string refusal(std::string_view text) {
    try {
        position_from_fen(text);
    } catch (const engine::Error& error) {
        return error.what();
    }
    return "read";
}

TEST(ChessFen, TheStartIsTheDefault) {
    EXPECT_EQ(Chess().to_text(), start_fen);
    EXPECT_EQ(Chess::from_text(start_fen), Chess());
    EXPECT_EQ(Chess::from_text("startpos"), Chess());
}

TEST(ChessFen, MissingFieldsHaveTheirUsualValues) {
    EXPECT_EQ(reread("4k3/8/8/8/8/8/8/4K3 b"), "4k3/8/8/8/8/8/8/4K3 b - - 0 1");
    EXPECT_EQ(reread("4k3/8/8/8/8/8/8/4K2R w K -"), "4k3/8/8/8/8/8/8/4K2R w K - 0 1");
    EXPECT_EQ(reread("4k3/8/8/8/8/8/8/4K3 w - - 99 0"), "4k3/8/8/8/8/8/8/4K3 w - - 99 1");
}

TEST(ChessFen, EnPassantIsKeptOnlyWhereAPawnMayCapture) {
    EXPECT_EQ(reread("rnbqkbnr/pppppppp/8/8/4P3/8/PPPP1PPP/RNBQKBNR b KQkq e3 0 1"),
              "rnbqkbnr/pppppppp/8/8/4P3/8/PPPP1PPP/RNBQKBNR b KQkq - 0 1");
    constexpr auto capturable = "rnbqkbnr/ppp1pppp/8/8/3pP3/8/PPPP1PPP/RNBQKBNR b KQkq e3 0 3";
    EXPECT_EQ(reread(capturable), capturable);
    // The pawn that would capture is pinned sideways.
    EXPECT_EQ(reread("8/8/8/8/k2pP2R/8/8/4K3 b - e3 0 1"), "8/8/8/8/k2pP2R/8/8/4K3 b - - 0 1");
    // No pawn has just passed the square, or not of that player.
    EXPECT_EQ(reread("4k3/8/8/8/3p4/8/8/4K3 b - e3 0 1"), "4k3/8/8/8/3p4/8/8/4K3 b - - 0 1");
    EXPECT_EQ(reread("4k3/8/8/8/3pP3/8/8/4K3 b - e6 0 1"), "4k3/8/8/8/3pP3/8/8/4K3 b - - 0 1");
    EXPECT_EQ(reread("4k3/8/8/8/3pP3/8/4R3/4K3 b - e3 0 1"), "4k3/8/8/8/3pP3/8/4R3/4K3 b - - 0 1");
}

TEST(ChessFen, CastlingInThreeSpellings) {
    EXPECT_EQ(position_from_fen("r3k2r/8/8/8/8/8/8/R3K2R w HAha - 0 1"),
              position_from_fen("r3k2r/8/8/8/8/8/8/R3K2R w KQkq - 0 1"));
    // X-FEN: K is the outermost rook; the inner one needs its file.
    EXPECT_EQ(reread("4k3/8/8/8/8/8/8/4KR1R w K - 0 1"), "4k3/8/8/8/8/8/8/4KR1R w K - 0 1");
    EXPECT_EQ(reread("4k3/8/8/8/8/8/8/4KR1R w H - 0 1"), "4k3/8/8/8/8/8/8/4KR1R w K - 0 1");
    EXPECT_EQ(reread("4k3/8/8/8/8/8/8/4KR1R w F - 0 1"), "4k3/8/8/8/8/8/8/4KR1R w F - 0 1");
    EXPECT_EQ(reread("rr2k3/8/8/8/8/8/8/4K3 w b - 0 1"), "rr2k3/8/8/8/8/8/8/4K3 w b - 0 1");
    EXPECT_TRUE(Chess::from_text("4k3/8/8/8/8/8/8/4KR1R w F - 0 1").chess960());
    EXPECT_TRUE(Chess::from_text("1r3k1r/8/8/8/8/8/8/4K3 w k - 0 1").chess960());
    EXPECT_FALSE(Chess::from_text("r3k2r/8/8/8/8/8/8/R3K2R w KQkq - 0 1").chess960());
}

TEST(ChessFen, RefusesWhatIsNoPosition) {
    using testing::HasSubstr;
    EXPECT_THAT(refusal(""), HasSubstr("lacks the side to move"));
    EXPECT_THAT(refusal("8/8/8/8/8/8/8/8 w - - 0 1"), HasSubstr("White has 0 kings"));
    EXPECT_THAT(refusal("4k3/8/8/8/8/8/8/3KK3 w - - 0 1"), HasSubstr("White has 2 kings"));
    EXPECT_THAT(refusal("3kk3/8/8/8/8/8/8/4K3 w - - 0 1"), HasSubstr("Black has 2 kings"));
    EXPECT_THAT(refusal("4k2P/8/8/8/8/8/8/4K3 w - - 0 1"), HasSubstr("first or last rank"));
    EXPECT_THAT(refusal("4k3/8/8/8/8/8/8/p3K3 w - - 0 1"), HasSubstr("first or last rank"));
    EXPECT_THAT(refusal("4k3/8/8/8/8/8/8/K3R3 w - - 0 1"), HasSubstr("Black is in check"));
    EXPECT_THAT(refusal("4k3/4K3/8/8/8/8/8/8 w - - 0 1"), HasSubstr("in check"));
    EXPECT_THAT(refusal("4k3/8/8/8/8/8/PPPPPPPP/P3K3 w - - 0 1"), HasSubstr("more than 8 pawns"));
    EXPECT_THAT(refusal("4k3/8/8/8/8/Q7/QQQQQQQQ/QQQQKQQQ w - - 0 1"),
                HasSubstr("more than 16 pieces"));
    EXPECT_THAT(refusal("4k3/8/8/8/8/8/8/4K3 x - - 0 1"), HasSubstr("side to move is \"x\""));
}

TEST(ChessFen, RefusesMalformedFields) {
    using testing::HasSubstr;
    EXPECT_THAT(refusal("4k3/8/8/8/8/8/8/8/4K3 w - - 0 1"), HasSubstr("more than 8 ranks"));
    EXPECT_THAT(refusal("4k3/8/8/8/8/4K3 w - - 0 1"), HasSubstr("fewer than 8 ranks"));
    EXPECT_THAT(refusal("4k4/8/8/8/8/8/8/4K3 w - - 0 1"), HasSubstr("rank 8"));
    EXPECT_THAT(refusal("4k2/8/8/8/8/8/8/4K3 w - - 0 1"), HasSubstr("has 7 squares"));
    EXPECT_THAT(refusal("4k3/8/8/8/8/8/8/4K9 w - - 0 1"), HasSubstr("unknown piece \"9\""));
    EXPECT_THAT(refusal("4k3/8/8/8/8/8/8/4K3 w K - 0 1"), HasSubstr("without its rook"));
    EXPECT_THAT(refusal("4k3/8/8/8/8/4K3/8/7R w H - 0 1"), HasSubstr("king has left its rank"));
    EXPECT_THAT(refusal("4k3/8/8/8/8/8/8/4K2R w KK - 0 1"), HasSubstr("twice"));
    EXPECT_THAT(refusal("4k3/8/8/8/8/8/8/4KR1R w HF - 0 1"), HasSubstr("two rooks"));
    EXPECT_THAT(refusal("4k3/8/8/8/8/8/8/4K2R w Kx - 0 1"), HasSubstr("bad castling letter"));
    EXPECT_THAT(refusal("4k3/8/8/8/8/8/8/4K3 w - e9 0 1"), HasSubstr("en passant square \"e9\""));
    EXPECT_THAT(refusal("4k3/8/8/8/8/8/8/4K3 w - - -1 1"), HasSubstr("halfmove clock"));
    EXPECT_THAT(refusal("4k3/8/8/8/8/8/8/4K3 w - - 0 70000"), HasSubstr("move number"));
    EXPECT_THAT(refusal("4k3/8/8/8/8/8/8/4K3 w - - 0 1 2"), HasSubstr("unexpected \"2\""));
    EXPECT_THAT(refusal(std::string(5000, '8')), HasSubstr("longer than"));
}

}  // namespace
}  // namespace chess
