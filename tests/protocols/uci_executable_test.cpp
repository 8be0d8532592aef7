// `sanban uci`, `usi` and `solve` as programs of their own: what only the whole program has.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <limits>
#include <string>

#include "tests/protocols/uci_guest.h"
#include "tests/temporary_folder.h"

namespace protocols {

namespace {

using testing::has;
using testing::last_line;
using testing::lines_of;

std::string output_of(const std::string& arguments) {
    const auto command = std::string(SANBAN_EXECUTABLE) + " " + arguments;
    std::string text;
    auto* pipe = ::popen(command.c_str(), "r");
    for (int c = 0; (c = std::fgetc(pipe)) != EOF;) text += static_cast<char>(c);
    ::pclose(pipe);
    return text;
}

// What `sanban PROTOCOL` answers to these lines, with one thread and little memory.
std::string talk(const std::string& protocol, const std::string& lines) {
    const tests::TemporaryFolder folder;
    const auto input = (folder.path() / "input").string();
    std::ofstream(input) << lines;
    return output_of(protocol + " --threads 1 --memory 16 <" + input);
}

// Of all programs run so far by this one, in seconds.
[[maybe_unused]] double processor_time_of_children() {
    rusage usage{};
    ::getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

// In processor time, as others run beside the tests; the shell in between counts too. A sanitizer
// takes longer than that to start by itself.
#if !defined(SANBAN_SANITIZED)
TEST(UciExecutable, TheGreetingIsPrompt) {
    for (const std::string protocol : {"uci", "usi"}) {
        double least = std::numeric_limits<double>::infinity();
        for (int i = 0; i < 5; ++i) {
            const double before = processor_time_of_children();
            const auto answer = talk(protocol, protocol + "\nquit\n");
            least = std::min(least, processor_time_of_children() - before);
            EXPECT_EQ(last_line(answer), protocol + "ok");
        }
        EXPECT_LT(least, 0.05) << protocol;
    }
}
#endif

// Every line that must be known begins with a word that the protocol has.
TEST(UciExecutable, SaysNothingThatIsNotProtocol) {
    const auto answer =
        talk("uci",
             "uci\nisready\nxyzzy\n\nposition startpos moves e2e5\nsetoption name Hash value x\n"
             "setoption\nsetoption name\nsetoption name Hash\nsetoption name Hash value 0\n"
             "setoption name MultiPV value 99999999999999999999\nsetoption name WeightsFile value "
             "/nowhere/at.all\nisready\ngo nodes 20\nposition startpos moves e2e4\nucinewgame\n"
             "go wtime 100\nstop\nquit\n");
    int unknown = 0, answers = 0;
    for (const auto& line : lines_of(answer)) {
        const auto word = line.substr(0, line.find(' '));
        const bool known = word == "id" || word == "option" || word == "info" || word == "uciok" ||
                           word == "readyok" || word == "bestmove";
        EXPECT_TRUE(known) << line;
        unknown += has(line, "unknown command xyzzy");
        answers += word == "bestmove";
    }
    EXPECT_EQ(unknown, 1);
    EXPECT_GE(answers, 1);
}

TEST(UciExecutable, Chess960CastlesByTakingTheOwnRook) {
    const std::string position = "position fen 4k3/8/8/8/8/8/8/4K2R w K - 0 1";
    const std::string castle = "setoption name UCI_Chess960 value true\n" + position +
                               " moves e1h1 e8d8\ngo nodes 1\nquit\n";
    EXPECT_FALSE(has(talk("uci", castle), "error"));
    const auto plain = talk("uci", position + "\ngo nodes 5 searchmoves e1g1\n");
    EXPECT_TRUE(has(plain, "bestmove e1g1")) << plain;
    const auto turned = talk("uci", "setoption name UCI_Chess960 value true\n" + position +
                                        "\ngo nodes 5 searchmoves e1h1\n");
    EXPECT_TRUE(has(turned, "bestmove e1h1")) << turned;
    EXPECT_TRUE(has(talk("uci", "setoption name UCI_Chess960 value maybe\n"),
                    "UCI_Chess960 must be true or false, not maybe"));
}

TEST(UciExecutable, TheShareOfCapturesIsAnOption) {
    const auto score = [](int lambda) {
        const auto told = talk("uci", fmt::format("setoption name Lambda value {}\nposition fen "
                                                  "4k3/8/8/8/8/8/8/R3K3 w - - 0 1\ngo nodes 20\n",
                                                  lambda));
        const auto at = told.find("score cp");
        EXPECT_NE(at, std::string::npos) << told;
        return told.substr(at, told.find(' ', at + 9) - at);
    };
    EXPECT_NE(score(1), score(0));
    EXPECT_TRUE(
        has(talk("uci", "setoption name Lambda value 2\n"), "lambda must lie in -1..1, not 2"));
}

TEST(UciExecutable, TheRuleOfDeclaringIsAnOption) {
    const std::string position = "position sfen KRRBB4/GGGG5/SSSS5/9/9/9/9/9/4k4 b 18P4N4L 1\n";
    EXPECT_TRUE(has(talk("usi", position + "go byoyomi 20\n"), "bestmove win"));
    EXPECT_FALSE(has(talk("usi", "setoption name EnteringKingRule value NoEnteringKing\n" +
                                     position + "go byoyomi 20\n"),
                     "bestmove win"));
    EXPECT_TRUE(has(talk("usi", "setoption name EnteringKingRule value Mine\n"),
                    "EnteringKingRule must be one of NoEnteringKing, CSARule24,"));
    EXPECT_TRUE(has(talk("usi", "setoption name MaxMovesToDraw value -1\n"),
                    "MaxMovesToDraw must lie in 0..100000, not -1"));
}

// Else a think ends when no second move can win any more.
TEST(UciExecutable, AnalysisUsesAllThatItIsGiven) {
    const std::string forced = "position fen 6k1/8/8/8/8/7q/8/7K w - - 0 1\ngo nodes 3000\n";
    const auto nodes_of = [](const std::string& answer) {
        const auto at = answer.rfind(" nodes ");
        return at == answer.npos ? -1 : std::stoi(answer.substr(at + 7));
    };
    EXPECT_LT(nodes_of(talk("uci", forced)), 3000);
    EXPECT_GE(nodes_of(talk("uci", "setoption name UCI_AnalyseMode value true\n" + forced)), 3000);
}

TEST(UciExecutable, SolvesProblemsOfFiles) {
    const tests::TemporaryFolder folder;
    const auto chess = (folder.path() / "mates.epd").string();
    std::ofstream(chess) << "6k1/5ppp/8/8/8/8/8/R3K3 w - - dm 1; id \"back rank\";\n"
                            "# a comment\n"
                            "7k/8/8/8/8/8/8/K7 w - - dm 1; id \"kings\";\n"
                            "6k1/5ppp/8/8/8/8/8/R3K3 w - - bm Ra8; am Ra7;\n";
    EXPECT_EQ(output_of("solve --simulations 2000 --memory 16 " + chess),
              "passed back rank: a1a8\nfailed kings: no mate, not a mate\npassed 4: a1a8\n"
              "2 passed, 1 failed\n");
    EXPECT_TRUE(has(output_of("solve --weights absent.safetensors --memory 16 " + chess + " 2>&1"),
                    "absent.safetensors"));
    const auto shogi = (folder.path() / "mates.sfen").string();
    std::ofstream(shogi) << "sfen 4k4/9/4P4/9/9/9/9/9/9 b G2r2b3g4s4n4l17p 1\n"
                            "4k4/9/4P4/9/9/9/9/9/9 b G2r2b3g4s4n4l17p bm G*5b; id \"gold\";\n";
    EXPECT_EQ(output_of("solve --simulations 2000 --memory 16 " + shogi),
              "passed 1: G*5b\npassed gold: G*5b\n2 passed, 0 failed\n");
}

}  // namespace protocols
