// Counts of legal moves that other programs agree on (chessprogramming.org "Perft Results", and
// Stockfish for the rest), of ordinary chess and Chess960.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <fstream>

#include "engine/base/random.h"
#include "engine/chess/chess.h"
#include "engine/perft.h"

namespace chess {
namespace {

std::uint64_t count(std::string_view fen, int depth) { return Chess::from_text(fen).perft(depth); }

TEST(ChessPerft, Start) { EXPECT_EQ(count("startpos", 6), 119060324u); }

TEST(ChessPerft, Kiwipete) {
    constexpr auto fen = "r3k2r/p1ppqpb1/bn2pnp1/3PN3/1p2P3/2N2Q1p/PPPBBPPP/R3K2R w KQkq - 0 1";
    EXPECT_EQ(count(fen, 5), 193690690u);
}

TEST(ChessPerft, EnPassantAndPins) {
    EXPECT_EQ(count("8/2p5/3p4/KP5r/1R3p1k/8/4P1P1/8 w - - 0 1", 6), 11030083u);
}

TEST(ChessPerft, Promotions) {
    EXPECT_EQ(count("r3k2r/Pppp1ppp/1b3nbN/nP6/BBP1P3/q4N2/Pp1P2PP/R2Q1RK1 w kq - 0 1", 5),
              15833292u);
    EXPECT_EQ(count("n1n5/PPPk4/8/8/8/8/4Kppp/5N1N b - - 0 1", 6), 71179139u);
}

TEST(ChessPerft, ChecksOnTheSeventhRank) {
    EXPECT_EQ(count("rnbq1k1r/pp1Pbppp/2p5/8/2B5/8/PPP1NnPP/RNBQK2R w KQ - 1 8", 5), 89941194u);
}

// The first, the last and a few others of the well-known list of 960 starting positions played on.
TEST(ChessPerft, Chess960) {
    EXPECT_EQ(count("bqnb1rkr/pp3ppp/3ppn2/2p5/5P2/P2P4/NPP1P1PP/BQ1BNRKR w HFhf - 2 9", 5),
              8146062u);
    EXPECT_EQ(count("2nnrbkr/p1qppppp/8/1ppb4/6PP/3PP3/PPP2P2/BQNNRBKR w HEhe - 1 9", 5),
              16253601u);
    EXPECT_EQ(count("b1q1rrkb/pppppppp/3nn3/8/P7/1PPP4/4PPPP/BQNNRKRB w GE - 1 9", 5), 6417013u);
    EXPECT_EQ(count("qbbnnrkr/2pp2pp/p7/1p2pp2/8/P3PP2/1PPP1KPP/QBBNNR1R w hf - 0 9", 5), 9183776u);
}

// The castling rook shields the king from a rook behind it.
TEST(ChessPerft, CastlingRookMayBePinned) {
    const auto game = Chess::from_text("4k3/8/8/8/8/8/8/rR2K3 w B - 0 1");
    EXPECT_FALSE(game.move_from_text("e1b1"));
}

TEST(ChessPerft, ChecksAreTheMovesThatGiveCheck) {
    engine::Random random(7);
    constexpr std::array starts = {
        "startpos", "r3k2r/Pppp1ppp/1b3nbN/nP6/BBP1P3/q4N2/Pp1P2PP/R2Q1RK1 w kq - 0 1",
        "n1n5/PPPk4/8/8/8/8/4Kppp/5N1N b - - 0 1", "8/2p5/3p4/KP5r/1R3p1k/8/4P1P1/8 w - - 0 1"};
    int seen = 0;
    for (int i = 0; i < 80; ++i) {
        auto game = Chess::from_text(starts[static_cast<std::size_t>(i) % starts.size()]);
        for (int ply = 0; ply < 100 && game.outcome() == engine::Outcome::ongoing; ++ply) {
            const auto moves = game.legal_moves();
            auto expected = moves;
            expected.filter(
                [&](Move move) { return engine::after(game.position(), move).in_check(); });
            const auto checks = game.position().checks();
            ASSERT_EQ(checks.size(), expected.size()) << game.to_text();
            for (int k = 0; k < checks.size(); ++k) ASSERT_EQ(checks[k], expected[k]);
            seen += checks.size();
            game.play(moves[random.below(moves.size())]);
        }
    }
    EXPECT_GT(seen, 1000);
}

// A game that counts through engine::Game alone.
struct Slow : Chess {
    using Chess::Chess;
    static Slow from_text(std::string_view text) { return Slow(Chess::from_text(text).position()); }
    std::uint64_t perft(int) const = delete;
};

TEST(ChessPerft, GenericCountAgrees) {
    static_assert(engine::Game<Slow>);
    EXPECT_EQ(engine::perft(Slow(), 4), 197281u);
}

TEST(ChessPerft, SharedPositions) {
    std::ifstream in(SANBAN_SOURCE_DIR "/../shared/data/perft/chess.txt");
    if (!in)
        in.open(std::string(std::getenv("SANBAN_SHARED") ? std::getenv("SANBAN_SHARED") : "") +
                "/data/perft/chess.txt");
    if (!in) GTEST_SKIP() << "no ../shared/data/perft/chess.txt";
    int positions = 0;
    for (std::string line; std::getline(in, line); ++positions) {
        const auto game = Chess::from_text(line.substr(0, line.find(" ;")));
        for (auto at = line.find(" ; D"); at != line.npos; at = line.find(" ; D", at + 1))
            EXPECT_EQ(game.perft(line[at + 4] - '0'), std::stoull(line.substr(at + 6))) << line;
    }
    EXPECT_EQ(positions, 200);
}

}  // namespace
}  // namespace chess
