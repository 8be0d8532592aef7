// Counts of legal moves that YaneuraOu gives, and what every position met on the way must keep.
#include <gtest/gtest.h>

#include "engine/base/random.h"
#include "engine/perft.h"
#include "engine/shogi/movegen.h"
#include "engine/shogi/sfen.h"
#include "engine/shogi/shogi.h"
#include "engine/shogi/usi.h"
#include "tests/engine/shogi_data.h"

namespace shogi {
namespace {

std::uint64_t lines(std::string_view sfen, int depth) {
    return Shogi::from_text(sfen).perft(depth);
}

TEST(ShogiPerft, Start) {
    EXPECT_EQ(lines("startpos", 5), 19861490u);
    EXPECT_EQ(lines("startpos", 6), 547581517u);
}

// 593 moves, the most that any position has.
TEST(ShogiPerft, MostMoves) {
    constexpr auto sfen = "R8/2K1S1SSk/4B4/9/9/9/9/9/1L1L1L3 b RBGSNLP3g3n17p 1";
    EXPECT_EQ(lines(sfen, 1), 593u);
    EXPECT_EQ(lines(sfen, 2), 105677u);
    EXPECT_EQ(lines(sfen, 3), 53393368u);
}

TEST(ShogiPerft, Middlegame) {
    EXPECT_EQ(lines("l6nl/5+P1gk/2np1S3/p1p4Pp/3P2Sp1/1PPb2P1P/P5GS1/R8/LN4bKL w RGgsn5p 1", 3),
              4809015u);
}

// A game that counts through engine::Game alone: listed moves against counted ones.
struct Slow : Shogi {
    Slow() = default;
    explicit Slow(const Shogi& game) : Shogi(game) {}
    static Slow from_text(std::string_view text) { return Slow(Shogi::from_text(text)); }
    std::uint64_t perft(int) const = delete;
};

TEST(ShogiPerft, GenericCountAgrees) {
    static_assert(engine::Game<Slow>);
    EXPECT_EQ(engine::perft(Slow(), 4), 719731u);
    EXPECT_EQ(
        engine::perft(Slow::from_text("R8/2K1S1SSk/4B4/9/9/9/9/9/1L1L1L3 b RBGSNLP3g3n17p 1"), 2),
        105677u);
}

TEST(ShogiPerft, SharedPositions) {
    const auto positions = lines_of(shared_data() / "perft/shogi.txt");
    if (positions.empty()) GTEST_SKIP() << "no ../shared/data/perft/shogi.txt";
    for (const auto& line : positions) {
        const auto game = Shogi::from_text(line.substr(0, line.find(" ;")));
        for (auto at = line.find(" ; D"); at != line.npos; at = line.find(" ; D", at + 1))
            EXPECT_EQ(game.perft(line[at + 4] - '0'), std::stoull(line.substr(at + 6))) << line;
    }
    EXPECT_EQ(positions.size(), 200u);
}

// The sets behind a position agree with its board, and its SFEN gives it back.
void expect_sound(const Shogi& game) {
    const Position& position = game.position();
    for (int square = 0; square < square_count; ++square) {
        const Piece piece = position.at(square);
        EXPECT_EQ(has(position.occupied(), square), !piece.empty());
        const Bitboard alike = position.of(piece.player(), piece.kind());
        EXPECT_TRUE(piece.empty() || has(alike, square));
    }
    const auto again = Shogi::from_text(game.to_text());
    EXPECT_EQ(again.position(), position);
    EXPECT_EQ(again.to_text(), game.to_text());
    EXPECT_EQ(again.in_check(), game.in_check());
}

TEST(ShogiPerft, RandomGamesStaySound) {
    engine::Random random(7);
    for (int i = 0; i < 20; ++i) {
        Shogi game;
        for (int ply = 0; ply < 200 && game.outcome() == Outcome::ongoing; ++ply) {
            const auto moves = game.legal_moves();
            ASSERT_EQ(moves.size(), count_legal_moves(game.position()));
            const Shogi before = game;
            const Move move = moves[random.below(moves.size())];
            ASSERT_EQ(game.move_from_text(game.move_to_text(move)), move);
            auto checking = moves;
            checking.filter(
                [&](Move each) { return engine::after(game.position(), each).in_check(); });
            const auto found = checks(game.position());
            ASSERT_EQ(found.size(), checking.size());
            for (int k = 0; k < found.size(); ++k) ASSERT_EQ(found[k], checking[k]);
            game.play(move);
            ASSERT_EQ(game.in_check(), checking.contains(move));
            ASSERT_EQ(game.position_before(1), before.position());
            expect_sound(game);
        }
    }
}

}  // namespace
}  // namespace shogi
