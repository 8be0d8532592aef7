// Moves as text and the ends of games.
#include "engine/chess/chess.h"

#include <gtest/gtest.h>

#include <sstream>

#include "engine/base/random.h"
#include "engine/chess/san.h"

namespace chess {
namespace {

Chess played(std::string_view start, const std::string& moves) {
    Chess game = Chess::from_text(start);
    std::istringstream words(moves);
    for (std::string word; words >> word;) {
        const auto move = game.move_from_text(word);
        if (!move) ADD_FAILURE() << word << " is illegal in " << game.to_text();
        if (move) game.play(*move);
    }
    return game;
}

Ending ending(std::string_view fen) { return Chess::from_text(fen).ending(); }

TEST(Chess, Checkmate) {
    const auto game = played("startpos", "f2f3 e7e5 g2g4 d8h4");
    EXPECT_EQ(game.ending(), Ending::checkmate);
    EXPECT_EQ(game.outcome(), Outcome::second_wins);
    EXPECT_EQ(game.to_text(), "rnb1kbnr/pppp1ppp/8/4p3/6Pq/5P2/PPPPP2P/RNBQKBNR w KQkq - 1 3");
    EXPECT_TRUE(game.legal_moves().empty());
}

TEST(Chess, Stalemate) { EXPECT_EQ(ending("7k/5Q2/6K1/8/8/8/8/8 b - - 0 1"), Ending::stalemate); }

TEST(Chess, ThirdOccurrenceIsADrawAndTheFifthEndsRecords) {
    const std::string dance = "g1f3 g8f6 f3g1 f6g8 ";
    EXPECT_EQ(played("startpos", dance).repetitions(), 1);
    EXPECT_EQ(played("startpos", dance).ending(), Ending::none);
    const auto third = played("startpos", dance + dance);
    EXPECT_EQ(third.ending(), Ending::threefold_repetition);
    EXPECT_EQ(third.outcome(), Outcome::draw);
    EXPECT_EQ(third.forced_ending(), Ending::none);
    EXPECT_EQ(played("startpos", dance + dance + dance).forced_ending(), Ending::none);
    EXPECT_EQ(played("startpos", dance + dance + dance + dance).forced_ending(),
              Ending::fivefold_repetition);
}

TEST(Chess, ARepetitionNeedsTheSameRights) {
    // The rook's trip costs the right to castle, so the start position has not come back.
    const auto game = played("r3k2r/8/8/8/8/8/8/R3K2R w KQkq - 0 1", "h1g1 a8b8 g1h1 b8a8");
    EXPECT_EQ(game.repetitions(), 0);
    EXPECT_EQ(game.to_text(), "r3k2r/8/8/8/8/8/8/R3K2R w Qk - 4 3");
    // The first time, Black may capture en passant.
    const auto passed = played("4k3/8/8/8/3p4/8/4P3/4K3 w - - 0 1", "e2e4 e8e7 e1e2 e7e8 e2e1");
    EXPECT_EQ(passed.repetitions(), 0);
    // He may not where the capture would uncover his king: the position is the same then.
    const auto pinned = played("8/8/8/8/k2p3R/8/4P3/4K3 w - - 0 1", "e2e4 a4a5 e1e2 a5a4 e2e1");
    EXPECT_EQ(pinned.repetitions(), 1);
}

TEST(Chess, FiftyMovesUnlessMate) {
    EXPECT_EQ(ending("4k3/8/8/8/8/8/8/R3K3 w - - 99 80"), Ending::none);
    EXPECT_EQ(ending("4k3/8/8/8/8/8/8/R3K3 w - - 100 80"), Ending::fifty_moves);
    EXPECT_EQ(ending("R5k1/5ppp/8/8/8/8/8/4K3 b - - 100 80"), Ending::checkmate);
    const auto record = Chess::from_text("4k3/8/8/8/8/8/8/R3K3 w - - 150 80");
    EXPECT_EQ(record.forced_ending(), Ending::seventy_five_moves);
}

TEST(Chess, GamesGoOnBehindADraw) {
    auto game = played("4k3/8/8/8/8/8/8/R3K3 w - - 99 80", "a1a2");
    EXPECT_EQ(game.outcome(), Outcome::draw);
    game.play(*game.move_from_text("e8e7"));
    EXPECT_EQ(game.to_text(), "8/4k3/8/8/8/8/R7/4K3 w - - 101 81");
}

TEST(Chess, InsufficientMaterial) {
    for (const auto* fen : {"4k3/8/8/8/8/8/8/4K3 w - - 0 1", "4k3/8/8/8/8/8/8/4KN2 w - - 0 1",
                            "4k1b1/8/8/8/8/8/8/4K3 w - - 0 1", "4kb2/8/8/8/8/8/8/2B1K3 w - - 0 1"})
        EXPECT_EQ(ending(fen), Ending::insufficient_material) << fen;
    for (const auto* fen : {"4k3/8/8/8/8/8/P7/4K3 w - - 0 1", "4kn2/8/8/8/8/8/8/4KN2 w - - 0 1",
                            "4k3/8/8/8/8/8/8/3NKN2 w - - 0 1", "4kb2/8/8/8/8/8/8/4KB2 w - - 0 1",
                            "4k3/8/8/8/8/8/8/3NKB2 w - - 0 1", "4k3/8/8/8/8/8/8/4K1R1 w - - 0 1"})
        EXPECT_EQ(ending(fen), Ending::none) << fen;
}

TEST(Chess, CastlingInBothNotations) {
    const auto game = Chess::from_text("r3k2r/8/8/8/8/8/8/R3K2R w KQkq - 0 1");
    EXPECT_EQ(game.move_from_text("e1g1"), game.move_from_text("e1h1"));
    EXPECT_EQ(game.move_from_text("e1c1"), game.move_from_text("e1a1"));
    const Move castle = *game.move_from_text("e1g1");
    EXPECT_EQ(game.move_to_text(castle), "e1g1");
    auto fischer = game;
    fischer.set_chess960(true);
    EXPECT_EQ(fischer.move_to_text(castle), "e1h1");
    EXPECT_EQ(fischer.move_from_text("e1g1"), castle);
    auto next = game;
    next.play(castle);
    EXPECT_EQ(next.to_text(), "r3k2r/8/8/8/8/8/8/R4RK1 b kq - 1 1");
}

TEST(Chess, CastlingInChess960) {
    // The king stands on its goal already; f1g1 is a step, f1h1 castles.
    const auto game = Chess::from_text("1r3k1r/8/8/8/8/8/8/1R3K1R w HBhb - 0 1");
    auto step = game, castled = game, long_castled = game;
    step.play(*game.move_from_text("f1g1"));
    EXPECT_EQ(step.to_text(), "1r3k1r/8/8/8/8/8/8/1R4KR b kq - 1 1");
    castled.play(*game.move_from_text("f1h1"));
    EXPECT_EQ(castled.to_text(), "1r3k1r/8/8/8/8/8/8/1R3RK1 b kq - 1 1");
    long_castled.play(*game.move_from_text("f1b1"));
    EXPECT_EQ(long_castled.to_text(), "1r3k1r/8/8/8/8/8/8/2KR3R b kq - 1 1");
    EXPECT_EQ(game.move_to_text(*game.move_from_text("f1b1")), "f1b1");
}

TEST(Chess, RejectsMovesThatAreNone) {
    const Chess game;
    for (const auto* text : {"", "e2", "e2e5", "e7e5", "e2e4q", "0000", "e2e4 ", "i2i4", "e1g1"})
        EXPECT_FALSE(game.move_from_text(text)) << text;
    const auto promoting = Chess::from_text("7k/P7/8/8/8/8/8/K7 w - - 0 1");
    EXPECT_FALSE(promoting.move_from_text("a7a8"));
    EXPECT_FALSE(promoting.move_from_text("a7a8k"));
    EXPECT_TRUE(promoting.move_from_text("a7a8q"));
}

TEST(Chess, RemembersTheLastEightBoards) {
    auto game = played("startpos", "g1f3 g8f6 f3g1 f6g8 e2e4");
    EXPECT_EQ(game.board_before(0)->board, PackedBoard(game.position()));
    EXPECT_EQ(game.board_before(1)->board, PackedBoard(Position()));
    EXPECT_EQ(game.board_before(1)->repetitions, 1);
    EXPECT_EQ(game.board_before(5)->board, PackedBoard(Position()));
    EXPECT_EQ(game.board_before(5)->repetitions, 0);
    EXPECT_FALSE(game.board_before(6));
    for (const auto* text : {"e7e5", "d2d4", "d7d5", "a2a3"}) game.play(*game.move_from_text(text));
    EXPECT_TRUE(game.board_before(7));
    EXPECT_FALSE(game.board_before(8));
    const auto board = game.board_before(7)->board;
    EXPECT_EQ(board.pieces(Player::first, Piece::knight), bit(1) | bit(21));
    EXPECT_EQ(board.pieces(Player::second, Piece::knight), bit(57) | bit(45));
}

// Calls check(game) on the positions of random games, every second one of Chess960.
template <class Check>
void on_random_games(Check check) {
    engine::Random random(7);
    for (int round = 0; round < 60; ++round) {
        auto game =
            round % 2 == 0
                ? Chess()
                : Chess::from_text("brkrqnnb/pppppppp/8/8/8/8/PPPPPPPP/BRKRQNNB w DBdb - 0 1");
        for (int ply = 0; ply < 200 && game.outcome() == Outcome::ongoing; ++ply) {
            check(game);
            const auto moves = game.legal_moves();
            game.play(moves[random.below(moves.size())]);
        }
    }
}

TEST(Chess, KeyAndRightsAreThoseOfThePositionReadAnew) {
    on_random_games([](const Chess& game) {
        const auto read = Chess::from_text(game.to_text());
        ASSERT_EQ(read.position(), game.position()) << game.to_text();
        ASSERT_EQ(read.key(), game.key());
    });
}

TEST(Chess, MovesSurviveEveryNotation) {
    on_random_games([](const Chess& game) {
        for (const Move move : game.legal_moves()) {
            ASSERT_EQ(game.move_from_text(game.move_to_text(move)), move) << game.to_text();
            const auto text = san(game.position(), move);
            ASSERT_EQ(move_from_san(game.position(), text), move) << text << " " << game.to_text();
        }
        ASSERT_EQ(game.position().count_legal_moves(), game.legal_moves().size());
        ASSERT_EQ(game.position().has_legal_move(), !game.legal_moves().empty());
    });
}

std::string san_of(std::string_view fen, std::string_view uci) {
    const auto game = Chess::from_text(fen);
    return san(game.position(), *game.move_from_text(uci));
}

TEST(ChessSan, IsWrittenExactly) {
    EXPECT_EQ(san_of("startpos", "g1f3"), "Nf3");
    EXPECT_EQ(san_of("startpos", "e2e4"), "e4");
    EXPECT_EQ(san_of("r3k2r/8/8/8/8/8/8/R3K2R w KQkq - 0 1", "e1g1"), "O-O");
    EXPECT_EQ(san_of("r3k2r/8/8/8/8/8/8/R3K2R b KQkq - 0 1", "e8c8"), "O-O-O");
    EXPECT_EQ(san_of("8/3k4/8/8/8/8/8/R3K3 w Q - 0 1", "e1c1"), "O-O-O+");
    EXPECT_EQ(san_of("4k3/8/8/3pP3/8/8/8/4K3 w - d6 0 1", "e5d6"), "exd6");
    EXPECT_EQ(san_of("3rk3/4P3/8/8/8/8/8/4K3 w - - 0 1", "e7d8q"), "exd8=Q+");
    EXPECT_EQ(san_of("6k1/5ppp/8/8/8/8/8/R3K3 w - - 0 1", "a1a8"), "Ra8#");
    EXPECT_EQ(san_of("4k3/8/8/R6R/8/8/8/4K3 w - - 0 1", "a5d5"), "Rad5");
    EXPECT_EQ(san_of("4k3/8/R7/8/R7/8/8/4K3 w - - 0 1", "a4a5"), "R4a5");
    EXPECT_EQ(san_of("8/k7/8/8/4Q2Q/8/8/K6Q w - - 0 1", "h4e1"), "Qh4e1");
    // The other knight is pinned and needs no telling apart.
    EXPECT_EQ(san_of("4k3/4r3/8/8/8/4N3/8/N3K3 w - - 0 1", "a1c2"), "Nc2");
}

TEST(ChessSan, IsReadWithPatience) {
    const auto reads = [](std::string_view fen, std::string_view text) {
        const auto game = Chess::from_text(fen);
        const auto move = move_from_san(game.position(), text);
        return move ? game.move_to_text(*move) : "none";
    };
    for (const auto* text : {"Nf3", "Ngf3", "Ng1f3", "Ng1-f3", "N1f3", "Nf3!?", "Nf3+", "nf3"})
        EXPECT_EQ(reads("startpos", text), "g1f3") << text;
    for (const auto* text : {"e4", "Pe4", "e2e4", "e2-e4", "e4!!"})
        EXPECT_EQ(reads("startpos", text), "e2e4") << text;
    constexpr auto castling = "r3k2r/8/8/8/8/8/8/R3K2R w KQkq - 0 1";
    for (const auto* text : {"O-O", "0-0", "o-o", "OO", "O-O+", "0-0!"})
        EXPECT_EQ(reads(castling, text), "e1g1") << text;
    EXPECT_EQ(reads(castling, "0-0-0#"), "e1c1");
    constexpr auto promoting = "3rk3/4P3/8/8/8/8/8/4K3 w - - 0 1";
    for (const auto* text : {"exd8=Q+", "exd8=Q", "exd8Q", "exd8(Q)", "ed8=Q", "e7xd8=Q", "exd8/Q"})
        EXPECT_EQ(reads(promoting, text), "e7d8q") << text;
    EXPECT_EQ(reads(promoting, "exd8=N"), "e7d8n");
    EXPECT_EQ(reads("4k3/8/8/3pP3/8/8/8/4K3 w - d6 0 1", "exd6e.p."), "e5d6");
}

TEST(ChessSan, RejectsTheIllegalAndTheAmbiguous) {
    const Position start;
    for (const auto* text : {"", "x", "Nf4", "e5", "Nbf3", "O-O", "--", "Z0", "e4=Q", "Nf", "+",
                             ")", "=Q", "Nf3f3", "K", "Ng1e2f3"})
        EXPECT_FALSE(move_from_san(start, text)) << text;
    const auto two_rooks = Chess::from_text("4k3/8/8/R6R/8/8/8/4K3 w - - 0 1");
    EXPECT_FALSE(move_from_san(two_rooks.position(), "Rd5"));
    EXPECT_FALSE(move_from_san(Chess::from_text("8/P6k/8/8/8/8/8/K7 w - - 0 1").position(), "a8"));
}

TEST(Chess, NearMatesAreSeen) {
    const auto foresight = [](std::string_view fen) { return Chess::from_text(fen).forced_mate(); };
    EXPECT_FALSE(foresight("startpos"));
    auto game =
        Chess::from_text("r1bqkb1r/pppp1ppp/2n2n2/4p2Q/2B1P3/8/PPPP1PPP/RNB1K1NR w KQkq - 4 4");
    auto mate = game.forced_mate();
    ASSERT_TRUE(mate);
    EXPECT_EQ(mate->plies, 1);
    EXPECT_EQ(game.move_to_text(mate->move), "h5f7");
    // The rook may take the first check, the king has no way out.
    game = Chess::from_text("2r3k1/5ppp/8/8/8/8/4R3/4R2K w - - 0 1");
    mate = game.forced_mate();
    ASSERT_TRUE(mate);
    EXPECT_TRUE(mate->mates);
    EXPECT_EQ(mate->plies, 3);
    game.play(mate->move);
    mate = game.forced_mate();
    ASSERT_TRUE(mate);
    EXPECT_FALSE(mate->mates);
    EXPECT_EQ(mate->plies, 2);
    // With luft there is none, and after 49 moves by each side no time for it.
    EXPECT_FALSE(foresight("2r3k1/5pp1/7p/8/8/8/4R3/4R2K w - - 0 1"));
    EXPECT_TRUE(foresight("2r3k1/5ppp/8/8/8/8/4R3/4R2K w - - 97 90"));
    EXPECT_FALSE(foresight("2r3k1/5ppp/8/8/8/8/4R3/4R2K w - - 98 90"));
}

}  // namespace
}  // namespace chess
