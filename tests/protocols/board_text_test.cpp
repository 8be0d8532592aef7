#include "protocols/board_text.h"

#include <gtest/gtest.h>

#include <vector>

#include "engine/chess/pgn.h"
#include "engine/shogi/csa.h"
#include "engine/shogi/kif.h"

namespace protocols {

namespace {

template <engine::Game G>
std::vector<G> game_of(const std::vector<std::string>& moves) {
    std::vector<G> states(1);
    for (const auto& move : moves) {
        G next = states.back();
        next.play(next.move_from_text(move).value());
        states.push_back(next);
    }
    return states;
}

}  // namespace

TEST(BoardText, ChessHasFilesAndRanks) {
    EXPECT_EQ(diagram(chess::Chess::from_text("4k3/8/8/8/8/8/4P3/4K2R w K - 0 1")),
              "8  . . . . k . . .\n7  . . . . . . . .\n6  . . . . . . . .\n5  . . . . . . . .\n"
              "4  . . . . . . . .\n3  . . . . . . . .\n2  . . . . P . . .\n1  . . . . K . . R\n"
              "   a b c d e f g h\n4k3/8/8/8/8/8/4P3/4K2R w K - 0 1");
}

TEST(BoardText, ShogiHasHands) {
    const auto text = diagram(shogi::Shogi::from_text("4k4/9/4+P4/9/9/9/9/9/4K4 b RG2s3p 1"));
    EXPECT_TRUE(
        text.starts_with("White holds s2 p3\n  9 8 7 6 5 4 3 2 1\n"
                         " . . . . k . . . .  a\n"))
        << text;
    EXPECT_NE(text.find("\n . . . .+P . . . .  c\n"), text.npos) << text;
    EXPECT_NE(text.find("  i\nBlack holds R G\n4k4/9/4+P4/"), text.npos) << text;
}

TEST(BoardText, GamesAreSavedAsOthersReadThem) {
    const auto chess = chess::pgn::read_one(
        to_pgn(game_of<chess::Chess>({"f2f3", "e7e5", "g2g4", "d8h4"}), false));
    EXPECT_EQ(chess.main_line().size(), 4u);
    EXPECT_EQ(chess.result, "0-1");
    EXPECT_EQ(chess::pgn::read_one(to_pgn(game_of<chess::Chess>({"e2e4"}), true)).result, "1-0");

    const auto moves = game_of<shogi::Shogi>({"7g7f", "3c3d", "8h2b+"});
    const auto csa = shogi::csa::parse(to_shogi_record(moves, true, false)).at(0);
    EXPECT_EQ(csa.main_line().size(), 3u);
    EXPECT_EQ(csa.outcome(), engine::Outcome::first_wins);
    const auto kif = shogi::kif::parse(to_shogi_record(moves, false, true));
    EXPECT_EQ(kif.main_line(), csa.main_line());
    EXPECT_EQ(kif.ending(), shogi::Ending::interrupted);
}

}  // namespace protocols
