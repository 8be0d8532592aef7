// UCI over chess and USI over shogi, asked what tournament managers and GUIs ask.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <thread>

#include "engine/chess/chess.h"
#include "engine/chess/rollouts.h"
#include "engine/shogi/rollouts.h"
#include "engine/shogi/shogi.h"
#include "protocols/uci.h"
#include "tests/temporary_folder.h"

namespace protocols {

namespace {

template <class G>
struct Guest {
    explicit Guest(const Dialect& dialect)
        : uci(dialect, std::make_unique<GameSession<G>>(params()), "sanban", output) {}

    static search::SearchParams params() {
        search::SearchParams params;
        params.memory_mib = 16;
        return params;
    }
    std::string say(const std::string& lines) {
        text.str("");
        std::istringstream in(lines);
        uci.serve(in);
        return text.str();
    }

    std::ostringstream text;
    Output output{text};
    Uci uci;
};

struct Chess : Guest<chess::Chess> {
    Chess() : Guest(uci_dialect) {}
};
struct Shogi : Guest<shogi::Shogi> {
    Shogi() : Guest(usi_dialect) {}
};

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

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

std::string output_of(const std::string& arguments) {
    const auto command = std::string(SANBAN_EXECUTABLE) + " " + arguments;
    std::string text;
    auto* pipe = ::popen(command.c_str(), "r");
    for (int c = 0; (c = std::fgetc(pipe)) != EOF;) text += static_cast<char>(c);
    ::pclose(pipe);
    return text;
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
    EXPECT_TRUE(lines_of(none).back().starts_with("bestmove ")) << none;
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
    EXPECT_EQ(guest.say("go nodes 50\n").find(" wdl "), std::string::npos);
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

TEST(UciGames, SolvesProblemsOfFiles) {
    const tests::TemporaryFolder folder;
    const auto chess = (folder.path() / "mates.epd").string();
    std::ofstream(chess) << "6k1/5ppp/8/8/8/8/8/R3K3 w - - dm 1; id \"back rank\";\n"
                            "# a comment\n"
                            "7k/8/8/8/8/8/8/K7 w - - dm 1; id \"kings\";\n"
                            "6k1/5ppp/8/8/8/8/8/R3K3 w - - bm Ra8; am Ra7;\n";
    EXPECT_EQ(output_of("solve --simulations 2000 --memory 16 " + chess),
              "passed back rank: a1a8\nfailed kings: no mate, not a mate\npassed 4: a1a8\n"
              "2 passed, 1 failed\n");
    const auto shogi = (folder.path() / "mates.sfen").string();
    std::ofstream(shogi) << "sfen 4k4/9/4P4/9/9/9/9/9/9 b G2r2b3g4s4n4l17p 1\n"
                            "4k4/9/4P4/9/9/9/9/9/9 b G2r2b3g4s4n4l17p bm G*5b; id \"gold\";\n";
    EXPECT_EQ(output_of("solve --simulations 2000 --memory 16 " + shogi),
              "passed 1: G*5b\npassed gold: G*5b\n2 passed, 0 failed\n");
}

TEST(UciGames, TheGreetingIsPrompt) {
    const auto begin = std::chrono::steady_clock::now();
    const auto answer = output_of("uci --threads 1 </dev/null");
    // The greeting is 50 ms at most on an idle machine; here others run beside it.
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
    EXPECT_EQ(answer, "");
}

}  // namespace protocols
