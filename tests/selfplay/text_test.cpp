#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include "engine/base/error.h"
#include "selfplay/game_record.h"
#include "selfplay/process.h"
#include "selfplay/time_text.h"

namespace selfplay {
namespace {

using namespace std::chrono_literals;
using Words = std::vector<std::string>;

TEST(SplitCommand, UnderstandsQuotesAsAShellDoes) {
    EXPECT_EQ(split_command("gnugo --mode gtp"), (Words{"gnugo", "--mode", "gtp"}));
    EXPECT_EQ(split_command(R"(  a 'b  c'  "d \" 'e'" f\ g '' )"),
              (Words{"a", "b  c", R"(d " 'e')", "f g", ""}));
    EXPECT_EQ(split_command(R"(--x="1 2"'3\')"), (Words{R"(--x=1 23\)"}));
    EXPECT_THROW(split_command("a 'b"), engine::Error);
    EXPECT_THROW(split_command("   "), engine::Error);
    EXPECT_THROW(split_command("a\\"), engine::Error);
}

TEST(TimeText, ReadsEveryControl) {
    EXPECT_TRUE(time_from_text("none").unlimited);
    EXPECT_EQ(time_from_text("absolute 90").main, 90s);
    const auto fischer = time_from_text("fischer 60 0.5");
    EXPECT_FALSE(fischer.unlimited);
    EXPECT_EQ(fischer.increment, 500ms);
    const auto japanese = time_from_text("byoyomi 60 30 3");
    EXPECT_EQ(japanese.period, 30s);
    EXPECT_EQ(japanese.periods, 3);
    EXPECT_EQ(japanese.period_moves, 1);
    const auto canadian = time_from_text("canadian 0 300 25");
    EXPECT_EQ(canadian.periods, 1);
    EXPECT_EQ(canadian.period_moves, 25);
    EXPECT_EQ(time_from_text("session 300 40 2").moves_per_session, 40);
    EXPECT_EQ(time_from_text("move 5").period, 5s);
}

TEST(TimeText, RefusesTheRest) {
    for (const auto* text :
         {"", "blitz 5", "absolute", "absolute x", "absolute -1", "fischer 1", "byoyomi 1 2 0.5",
          "canadian 1 2 0", "move 5 5", "absolute 0", "absolute 1e9", "absolute nan"})
        EXPECT_THROW(time_from_text(text), engine::Error) << text;
}

TEST(GameRecord, SurvivesItsOwnJson) {
    GameRecord record;
    record.index = 7;
    record.first = 1;
    record.names = {"a \"quoted\"", "b"};
    record.moves = {"D4", "pass"};
    record.milliseconds = {12};
    record.opening_moves = 1;
    record.outcome = engine::Outcome::second_wins;
    record.reason = "crash";
    record.detail = "killed by signal 9";
    record.dead = {"A1"};
    const auto line = to_json(record);
    EXPECT_EQ(line.find('\n'), std::string::npos);
    EXPECT_EQ(record_from_json(line), record);
    EXPECT_EQ(record.winner(), 0);
    EXPECT_TRUE(record.by_fault());
}

TEST(GameRecord, RefusesOtherText) {
    for (const auto* text : {"", "{}", "[]", "{\"game\":\"x\"}", "\xff"})
        EXPECT_THROW(record_from_json(text), engine::Error) << text;
}

// Not by the command line, which is empty for a moment while a process becomes another program.
bool runs(const std::string& pid) {
    std::ifstream in("/proc/" + pid + "/stat");
    std::string line;
    if (!std::getline(in, line)) return false;
    const char state = line.at(line.rfind(')') + 2);
    return state != 'Z' && state != 'X';
}

TEST(Process, KillsTheWholeGroup) {
    std::string grandchild;
    {
        Process process("bash -c 'sleep 1000 & echo $!; read'", {});
        grandchild = process.read_line(Clock::now() + 5s);
        ASSERT_TRUE(runs(grandchild));
    }
    for (int i = 0; i < 100 && runs(grandchild); ++i) std::this_thread::sleep_for(10ms);
    EXPECT_FALSE(runs(grandchild));
}

TEST(Process, StripsCarriageReturnsAndKeepsWhatFollows) {
    Process process(R"(printf 'one\r\ntwo\n\nlast')", {});
    const auto deadline = Clock::now() + 5s;
    EXPECT_EQ(process.read_line(deadline), "one");
    EXPECT_EQ(process.read_line(deadline), "two");
    EXPECT_EQ(process.read_line(deadline), "");
    EXPECT_THROW(process.read_line(deadline), Fault);
}

TEST(Process, AChildThatDoesNotReadIsNoTrap) {
    Process process("sleep 100", {});
    const auto begin = Clock::now();
    const std::string line(1 << 20, 'x');
    EXPECT_THROW(process.write_line(line, begin + 200ms), Fault);
    EXPECT_LT(Clock::now() - begin, 3s);
}

}  // namespace
}  // namespace selfplay
