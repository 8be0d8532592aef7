// UCI over chess and USI over shogi, asked what tournament managers and GUIs ask.
#include <gtest/gtest.h>

#include <sstream>

#include "engine/chess/chess.h"
#include "engine/chess/rollouts.h"
#include "engine/shogi/rollouts.h"
#include "engine/shogi/shogi.h"
#include "tests/protocols/uci_guest.h"

namespace protocols {

namespace {

using testing::has;
using testing::last_line;
using testing::lines_of;

struct Chess : testing::UciGuest<chess::Chess> {};
struct Shogi : testing::UciGuest<shogi::Shogi> {
    Shogi() : UciGuest(usi_dialect) {}
};

// Info lines with whole numbers behind time, nps and score, then one bestmove, then nothing.
void expect_a_think(const std::string& text) {
    const auto lines = lines_of(text);
    ASSERT_GE(lines.size(), 2u) << text;
    EXPECT_TRUE(lines.back().starts_with("bestmove ")) << text;
    for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
        EXPECT_TRUE(lines[i].starts_with("info ")) << text;
        std::istringstream words(lines[i]);
        int numbers = 0;
        for (std::string word; words >> word;) {
            if (word == "score") words >> word;
            int value = 0;
            if (word == "time" || word == "nps" || word == "cp" || word == "mate")
                numbers += static_cast<bool>(words >> value);
        }
        EXPECT_EQ(numbers, 3) << lines[i];
    }
}

}  // namespace

// What `fastchess --compliance` sends.
TEST(UciGames, EveryFormOfTheClockIsAnswered) {
    Chess guest;
    for (const std::string position : {"position startpos", "position startpos moves e2e4",
                                       "position fen 4k3/8/8/8/8/8/4P3/4K3 b - - 0 1"})
        for (const std::string go :
             {"go wtime 100", "go btime 100", "go wtime 100 btime 100",
              "go wtime 100 winc 10 btime 100 binc 10", "go btime 100 binc 10 wtime 100 winc 10",
              "go winc 10 wtime 100 binc 10 btime 100", "go movetime 20", "go nodes 50",
              "go depth 2", "go wtime 50 btime 50 movestogo 1"})
            expect_a_think(guest.say(position + "\nucinewgame\n" + go + "\n"));
}

TEST(UciGames, ShogiClocksAreAnswered) {
    Shogi guest;
    for (const std::string go :
         {"go btime 100 wtime 100", "go btime 0 wtime 0 byoyomi 50", "go wtime 100",
          "go btime 100 wtime 100 binc 10 winc 10", "go byoyomi 50", "go nodes 50"})
        expect_a_think(guest.say("position startpos moves 7g7f\nusinewgame\n" + go + "\n"));
}

TEST(UciGames, MatesOfUciAreMoves) {
    Chess guest;
    const auto found = guest.say("position fen r6k/6pp/8/6N1/8/1Q6/8/6K1 w - - 0 1\ngo mate 4\n");
    EXPECT_NE(found.find(" score mate 4 "), found.npos) << found;
    EXPECT_NE(found.find("\nbestmove g5f7 ponder h8g8\n"), found.npos) << found;
    const auto none = guest.say("position startpos\ngo mate 1\n");
    EXPECT_NE(none.find("info string found no such mate\n"), none.npos);
    EXPECT_TRUE(last_line(none).starts_with("bestmove ")) << none;
    for (const std::string go :
         {"go mate 1 nodes 200 searchmoves e1e2", "go mate 1 searchmoves e1e2"}) {
        const auto other =
            guest.say("position fen 6k1/5ppp/8/8/8/8/8/R3K3 w - - 0 1\n" + go + "\n");
        EXPECT_TRUE(last_line(other).starts_with("bestmove e1e2")) << other;
    }
}

TEST(UciGames, MatesOfUsiAreSolutions) {
    Shogi guest;
    const std::string mate = "position sfen 4k4/9/4P4/9/9/9/9/9/9 b G2r2b3g4s4n4l17p 1\n";
    EXPECT_EQ(guest.say(mate + "go mate 5000\n"), "checkmate G*5b\n");
    EXPECT_EQ(guest.say("position startpos\ngo mate infinite\n"), "checkmate nomate\n");
    EXPECT_EQ(guest.say("position startpos\ngo mate\n"), "checkmate nomate\n");
}

TEST(UciGames, AStopEndsAMateSearch) {
    Chess guest;
    guest.uci.handle("position startpos");
    for (int i = 0; i < 20; ++i) {
        guest.text.str("");
        guest.uci.handle("go mate 20");
        guest.uci.handle("stop");
        EXPECT_TRUE(lines_of(guest.text.str()).back().starts_with("bestmove "));
    }
}

TEST(UciGames, WdlIsShownWhenAskedFor) {
    Chess guest;
    EXPECT_FALSE(has(guest.say("go nodes 50\n"), " wdl "));
    const auto text = guest.say("setoption name UCI_ShowWDL value true\ngo nodes 50\n");
    const auto at = text.find(" wdl ");
    ASSERT_NE(at, text.npos) << text;
    std::istringstream numbers(text.substr(at + 5));
    int wins = -1, draws = -1, losses = -1;
    numbers >> wins >> draws >> losses;
    EXPECT_GE(std::min({wins, draws, losses}), 0);
    EXPECT_EQ(wins + draws + losses, 1000);
}

TEST(UciGames, AWinIsDeclared) {
    Shogi guest;
    // King in the camp with ten men beside it and 28 points and more.
    const auto text =
        guest.say("position sfen KRRBB4/GGGG5/SSSS5/9/9/9/9/9/4k4 b 18P4N4L 1\ngo byoyomi 50\n");
    EXPECT_EQ(text, "bestmove win\n");
}

// What GUIs of shogi send early: the times come with the ponderhit.
TEST(UciGames, PonderingOfShogiMayEndInADeclaration) {
    Shogi guest;
    guest.uci.handle("position sfen KRRBB4/GGGG5/SSSS5/9/9/9/9/9/4k4 b 18P4N4L 1");
    guest.uci.handle("go ponder btime 1000 wtime 1000 byoyomi 50");
    EXPECT_FALSE(has(guest.text.str(), "bestmove"));
    guest.uci.handle("ponderhit");
    std::istringstream end;
    guest.uci.serve(end);
    EXPECT_EQ(last_line(guest.text.str()), "bestmove win");
}

TEST(UciGames, PonderingInAFinishedGameAnswersWhenStopped) {
    Chess guest;
    for (const std::string go : {"go ponder wtime 100 btime 100", "go infinite"}) {
        guest.text.str("");
        guest.uci.handle("position startpos moves f2f3 e7e5 g2g4 d8h4");
        guest.uci.handle(go);
        EXPECT_FALSE(has(guest.text.str(), "bestmove"));
        guest.uci.handle("stop");
        EXPECT_EQ(last_line(guest.text.str()), "bestmove (none)") << go;
    }
}

// `isready` is answered while the search goes on, and changes nothing.
TEST(UciGames, IsReadyDoesNotEndAThink) {
    Chess guest;
    guest.uci.handle("go infinite");
    guest.uci.handle("isready");
    EXPECT_TRUE(has(guest.text.str(), "readyok\n"));
    EXPECT_FALSE(has(guest.text.str(), "bestmove"));
    guest.uci.handle("stop");
    EXPECT_TRUE(last_line(guest.text.str()).starts_with("bestmove "));
}

struct Refusal {
    std::string position, reason;
};

// The reason, in one line, and the position from before stays.
template <class Guest>
void expect_refused(const std::string& word, const std::vector<Refusal>& refusals) {
    Guest guest;
    const auto before = last_line(guest.say("position startpos\ngo nodes 1\n"));
    for (const auto& [position, reason] : refusals) {
        const auto answer = guest.say("position " + word + " " + position + "\n");
        EXPECT_TRUE(answer.starts_with("info string error: ")) << answer;
        EXPECT_EQ(lines_of(answer).size(), 1u) << answer;
        EXPECT_TRUE(has(answer, reason)) << answer;
        EXPECT_LT(answer.size(), 400u) << answer.substr(0, 400);
        EXPECT_EQ(last_line(guest.say("ucinewgame\nusinewgame\ngo nodes 1\n")), before);
    }
}

TEST(UciGames, IllegalFensAreRefusedWithTheReason) {
    expect_refused<Chess>("fen", {{"4k3/8/8/8/8/8/8/3KK3 w - - 0 1", "king"},
                                  {"P3k3/8/8/8/8/8/8/4K3 w - - 0 1", "pawn"},
                                  {"4k3/8/8/8/8/8/8/4KR1p w - - 0 1", "pawn"},
                                  {"4k3/8/8/8/8/8/8/4RK2 w - - 0 1", "check"},
                                  {"8/8/8/8/8/8/8/4K3 w - - 0 1", "king"},
                                  {"4k3/8/8/8/8/8/8/4K3/8 w - - 0 1", ""},
                                  {std::string(5000, '8') + " w - - 0 1", ""},
                                  {"4k3/8/8/8/8/8/8/4K3 x - - 0 1", ""}});
}

TEST(UciGames, IllegalSfensAreRefusedWithTheReason) {
    expect_refused<Shogi>("sfen", {{"4k4/9/9/9/9/9/9/9/3KK4 b - 1", "king"},
                                   {"P3k4/9/9/9/9/9/9/9/4K4 b - 1", "pawn"},
                                   {"4k4/9/9/9/9/9/9/9/4R1K2 b - 1", "check"},
                                   {"4k4/9/9/9/4P4/4P4/9/9/4K4 b - 1", "pawn"},
                                   {"4k4/9/9/9/9/9/9/9/4K4 b 19p 1", ""},
                                   {std::string(5000, '9') + " b - 1", ""},
                                   {"4k4/9/9/9/9/9/9/9/4K4 x - 1", ""}});
}

}  // namespace protocols
