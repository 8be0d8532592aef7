// The UCI front end over the smallest game there is.
#include "protocols/uci.h"

#include <gtest/gtest.h>

#include <sstream>
#include <thread>

#include "tests/protocols/uci_guest.h"
#include "tests/search/tictactoe.h"

namespace protocols {

using testing::has;
using testing::last_line;

using Guest = testing::UciGuest<tictactoe::TicTacToe>;

TEST(Uci, SaysWhoItIsAndWhatCanBeSet) {
    Guest guest;
    const auto answer = guest.say("uci\nisready\n");
    EXPECT_TRUE(answer.starts_with("id name sanban\nid author "));
    EXPECT_TRUE(has(answer, "option name Threads type spin default 1 min 1 max 1024\n"));
    EXPECT_TRUE(has(answer, "option name Hash type spin default 16 min "));
    EXPECT_TRUE(answer.ends_with("uciok\nreadyok\n"));
}

TEST(Uci, UsiOptionsHaveNoBlanksInTheirNames) {
    Guest guest(usi_dialect);
    std::istringstream in(guest.say("usi\n"));
    int options = 0;
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string option, name, value, type;
        words >> option >> name >> value >> type;
        if (option != "option") continue;
        ++options;
        EXPECT_EQ(name, "name");
        EXPECT_EQ(type, "type") << line;
    }
    EXPECT_GT(options, 4);
}

TEST(Uci, FindsAWinInOneAndEndsWithBestmove) {
    Guest guest;
    const auto answer = guest.say("position startpos moves 1 4 2 5\ngo nodes 500\n");
    EXPECT_TRUE(last_line(answer).starts_with("bestmove 3")) << answer;
    EXPECT_TRUE(has(answer, "info depth "));
    EXPECT_TRUE(has(answer, " score mate 1 ")) << answer;
    EXPECT_TRUE(has(answer, " multipv 1 pv 3\n"));
}

TEST(Uci, SearchMovesAreObeyed) {
    Guest guest;
    const auto answer = guest.say("position startpos moves 1 4 2 5\ngo nodes 100 searchmoves 9\n");
    EXPECT_TRUE(last_line(answer).starts_with("bestmove 9")) << answer;
}

TEST(Uci, MultiPvListsSeveralMoves) {
    Guest guest;
    const auto answer =
        guest.say("setoption name MultiPV value 3\nposition startpos\ngo nodes 200\n");
    EXPECT_TRUE(has(answer, " multipv 3 pv "));
    EXPECT_FALSE(has(answer, " multipv 4 pv "));
}

// The fewer of the two count; analysis goes on until it is stopped.
TEST(Uci, SimulationsAreAtMostThoseSet) {
    Guest guest;
    guest.say("setoption name Simulations value 70\nposition startpos\n");
    const auto shown = [&](const char* go, const char* nodes) {
        const auto answer = guest.say(go);
        const auto last = answer.rfind("info depth");
        EXPECT_TRUE(has(answer.substr(last), nodes)) << answer;
        EXPECT_TRUE(last_line(answer).starts_with("bestmove")) << answer;
    };
    shown("go wtime 600000 btime 600000\n", " nodes 70 ");
    shown("go nodes 1000\n", " nodes 70 ");
    shown("go nodes 40\n", " nodes 40 ");
    guest.text.str("");
    EXPECT_TRUE(guest.uci.handle("go infinite"));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_FALSE(has(guest.text.str(), "bestmove"));
    EXPECT_TRUE(guest.uci.handle("stop"));
    EXPECT_FALSE(has(guest.text.str(), " nodes 70 "));
    EXPECT_EQ(guest.say("setoption name Simulations value -1\n").substr(0, 18),
              "info string error:");
}

TEST(Uci, ABadPositionLeavesTheOldOne) {
    Guest guest;
    const auto answer =
        guest.say("position startpos moves 1 4 2 5\nposition startpos moves 1 1\ngo nodes 500\n");
    EXPECT_TRUE(answer.starts_with("info string error: illegal move 1 (number 2)\n")) << answer;
    EXPECT_TRUE(last_line(answer).starts_with("bestmove 3"));
}

TEST(Uci, UnknownCommandsAreIgnoredWithOneLine) {
    Guest guest;
    EXPECT_EQ(guest.say("xyzzy 1 2\n"), "info string unknown command xyzzy\n");
    EXPECT_EQ(guest.say("setoption name Nonsense value 3\n"),
              "info string error: there is no option 'Nonsense'\n");
    EXPECT_EQ(guest.say("setoption name Threads value 0\n"),
              "info string error: threads must lie in 1..1024, not 0\n");
    EXPECT_EQ(guest.say("position fen\n"),
              "info string error: position fen: the position is missing\n");
    EXPECT_EQ(guest.say("\n   \nisready\n"), "readyok\n");
}

TEST(Uci, NothingBestWhenTheGameIsOver) {
    Guest guest;
    EXPECT_EQ(guest.say("position startpos moves 1 4 2 5 3\ngo nodes 10\n"), "bestmove (none)\n");
    Guest shogi(usi_dialect);
    EXPECT_EQ(shogi.say("position startpos moves 1 4 2 5 3\ngo nodes 10\n"), "bestmove resign\n");
}

// Whoever waits for a move gets one, whatever is set meanwhile.
TEST(Uci, AnOptionDuringAThinkLosesNoMove) {
    Guest guest;
    for (const auto* const option : {"MultiPV value 2", "Threads value 0", "Hash value 16"}) {
        guest.text.str("");
        EXPECT_TRUE(guest.uci.handle("position startpos"));
        EXPECT_TRUE(guest.uci.handle("go infinite"));
        EXPECT_TRUE(guest.uci.handle(std::string("setoption name ") + option));
        EXPECT_FALSE(has(guest.text.str(), "bestmove")) << option;
        EXPECT_TRUE(guest.uci.handle("stop"));
        EXPECT_TRUE(last_line(guest.text.str()).starts_with("bestmove")) << guest.text.str();

        guest.text.str("");
        EXPECT_TRUE(guest.uci.handle("go movetime 100000"));
        EXPECT_TRUE(guest.uci.handle(std::string("setoption name ") + option));
        EXPECT_TRUE(has(guest.text.str(), "bestmove")) << guest.text.str();
    }
}

TEST(Uci, AMoveTimeHoldsTheOverhead) {
    Guest guest;
    const auto begun = std::chrono::steady_clock::now();
    const auto answer =
        guest.say("setoption name Move Overhead value 500\nposition startpos\ngo movetime 1000\n");
    const auto took = std::chrono::steady_clock::now() - begun;
    EXPECT_TRUE(last_line(answer).starts_with("bestmove")) << answer;
    EXPECT_GE(took, std::chrono::milliseconds(400));
    EXPECT_LT(took, std::chrono::milliseconds(1000));
}

TEST(Uci, AnEndlessThinkWaitsForStop) {
    Guest guest;
    guest.text.str("");
    EXPECT_TRUE(guest.uci.handle("position startpos"));
    EXPECT_TRUE(guest.uci.handle("go infinite"));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_FALSE(has(guest.text.str(), "bestmove"));
    EXPECT_TRUE(guest.uci.handle("stop"));
    EXPECT_TRUE(last_line(guest.text.str()).starts_with("bestmove "));
    guest.text.str("");
    EXPECT_TRUE(guest.uci.handle("stop"));
    EXPECT_EQ(guest.text.str(), "");
}

TEST(Uci, AStopRightAfterGoHasABestmove) {
    Guest guest;
    for (int i = 0; i < 50; ++i) {
        guest.text.str("");
        guest.uci.handle("go infinite");
        guest.uci.handle("stop");
        ASSERT_TRUE(last_line(guest.text.str()).starts_with("bestmove ")) << guest.text.str();
    }
}

TEST(Uci, PonderingEndsByPonderhit) {
    Guest guest;
    guest.uci.handle("position startpos moves 1 4 2 5");
    guest.uci.handle("go ponder nodes 50");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_FALSE(has(guest.text.str(), "bestmove"));
    guest.uci.handle("ponderhit");
    std::istringstream end;
    guest.uci.serve(end);
    EXPECT_TRUE(last_line(guest.text.str()).starts_with("bestmove 3"));
}

TEST(Uci, LatePonderTimesStartTheClock) {
    Guest guest(usi_dialect);
    guest.uci.handle("position startpos moves 1 4 2 5");
    guest.uci.handle("go ponder");
    guest.uci.handle("ponderhit btime 0 wtime 0 byoyomi 100");
    std::istringstream end;
    guest.uci.serve(end);
    EXPECT_TRUE(last_line(guest.text.str()).starts_with("bestmove 3"));
}

TEST(Uci, CentipawnsGrowWithTheValue) {
    EXPECT_EQ(centipawns(0), 0);
    EXPECT_EQ(centipawns(-0.5f), -centipawns(0.5f));
    EXPECT_NEAR(centipawns(0.5f), 89, 2);
    EXPECT_LT(centipawns(0.9f), centipawns(1));
}

}  // namespace protocols
