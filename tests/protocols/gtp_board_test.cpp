// GTP commands about the table of commands, the position and the game's record.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "engine/base/files.h"
#include "tests/protocols/gtp_guest.h"
#include "tests/temporary_folder.h"

namespace protocols {

namespace {

std::vector<std::string> lines_of(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

}  // namespace

TEST(GtpTable, ListsAndHelpAndManualAgree) {
    GtpGuest guest;
    const auto names = lines_of(guest.ask("list_commands"));
    ASSERT_EQ(names.size(), Gtp::commands().size());
    const auto help = lines_of(guest.ask("help"));
    ASSERT_EQ(help.size(), names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
        EXPECT_EQ(guest.ask("known_command " + names[i]), "true");
        EXPECT_EQ(guest.ask("help " + names[i]), help[i]);
        EXPECT_TRUE(help[i].starts_with(names[i])) << help[i];
        EXPECT_TRUE(has(Gtp::manual(), "| `" + names[i] + "` |"));
        EXPECT_EQ(std::count(names.begin(), names.end(), names[i]), 1) << names[i];
    }
}

TEST(GtpTable, TheReadmeHasIt) {
    const std::filesystem::path root = SANBAN_SOURCE_DIR;
    EXPECT_TRUE(has(engine::read_file(root / "README.md"), Gtp::manual()));
}

TEST(GtpTable, KnowsWhatEveryManagerNeeds) {
    GtpGuest guest;
    for (const auto* name : {"protocol_version",
                             "name",
                             "version",
                             "known_command",
                             "list_commands",
                             "quit",
                             "boardsize",
                             "clear_board",
                             "komi",
                             "play",
                             "genmove",
                             "undo",
                             "time_settings",
                             "time_left",
                             "final_score",
                             "final_status_list",
                             "loadsgf",
                             "reg_genmove",
                             "showboard",
                             "fixed_handicap",
                             "place_free_handicap",
                             "set_free_handicap"})
        EXPECT_EQ(guest.ask(std::string("known_command ") + name), "true") << name;
}

TEST(GtpTable, NoCommandFailsToAnswerNonsense) {
    for (const auto& command : Gtp::commands()) {
        if (command.name == "quit" || command.name == "printsgf") continue;  // it would write
        GtpGuest guest(small_game(5, 20));
        guest.gtp.handle(std::string(command.name) + " \x80\xff -1 1e999 99999999999999999999");
        guest.gtp.handle(std::string(command.name));
        guest.gtp.handle("stop");
        const auto text = guest.text.str();
        EXPECT_TRUE(text.starts_with("=") || text.starts_with("?")) << command.name;
        EXPECT_TRUE(text.ends_with("\n\n")) << command.name << text;
    }
}

TEST(GtpBoard, FreeHandicapIsPlacedOnFreePoints) {
    for (const int stones : {2, 5, 9, 30, 80}) {
        GtpGuest guest;
        const auto placed = guest.ask("place_free_handicap " + std::to_string(stones));
        std::istringstream in(placed);
        EXPECT_EQ(std::distance(std::istream_iterator<std::string>(in), {}), stones) << placed;
        EXPECT_EQ(guest.ask("get_handicap"), std::to_string(stones));
        EXPECT_EQ(lines_of(guest.ask("list_stones b")).size(), 1U);
    }
}

TEST(GtpBoard, AllLegalPointsAreThoseThatIsLegalAccepts) {
    GtpGuest guest(small_game(5));
    guest.say("gogui-play_sequence b a2 b b1 w c1 w b3 w c2 b a4 w b2");
    for (const char* colour : {"b", "w"}) {
        const auto legal = fmt::format(" {} ", guest.ask(fmt::format("all_legal {}", colour)));
        for (const char column : std::string("ABCDE"))
            for (int row = 1; row <= 5; ++row) {
                const auto vertex = go::vertex({column - 'A', row - 1});
                const bool listed = has(legal, fmt::format(" {} ", vertex));
                EXPECT_EQ(guest.ask(fmt::format("is_legal {} {}", colour, vertex)),
                          listed ? "1" : "0");
            }
    }
}

TEST(GtpBoard, ShowsStonesAndPrisoners) {
    GtpGuest guest;
    guest.say("gogui-play_sequence b a2 w a1 b b1");
    const auto board = guest.raw("showboard");
    EXPECT_TRUE(board.starts_with("= \n"));
    EXPECT_TRUE(board.ends_with("\n\n"));
    // A blank line would end the answer too early.
    EXPECT_EQ(board.find("\n\n"), board.size() - 2);
    EXPECT_TRUE(has(board, "7.5"));
}

TEST(GtpBoard, RulesGoAroundAsJson) {
    for (const auto& named : go::named_rules()) {
        GtpGuest guest, other;
        EXPECT_EQ(guest.say("kata-set-rules " + std::string(named.name)), "=");
        const auto rules = guest.ask("kata-get-rules");
        EXPECT_EQ(other.say("kata-set-rules " + rules), "=");
        EXPECT_EQ(other.ask("kata-get-rules"), rules);
        EXPECT_EQ(go::rules_from_text(rules), named.rules) << named.name;
    }
}

TEST(GtpSgf, AGameComesBackFromAFile) {
    const tests::TemporaryFolder scratch;
    const auto file = (scratch.path() / "a game.sgf").string();
    GtpGuest guest;
    guest.say("kata-set-rules japanese");
    guest.say("komi -3.5");
    guest.say("fixed_handicap 3");
    guest.say("gogui-play_sequence w e5 b a1 b b1 w pass b c9");
    EXPECT_EQ(guest.say("printsgf " + file), "=");
    const auto text = guest.ask("printsgf");
    EXPECT_EQ(engine::read_file(file), text + "\n");
    EXPECT_EQ(guest.ask("printsgf -"), text);

    GtpGuest other(small_game(19));
    EXPECT_EQ(other.ask("loadsgf " + file), "white");
    for (const auto* question : {"printsgf", "showboard", "move_history", "kata-get-rules",
                                 "get_komi", "get_handicap", "query_boardsize"})
        EXPECT_EQ(other.ask(question), guest.ask(question)) << question;
    // To before move 3: two moves are played.
    EXPECT_EQ(other.ask("loadsgf " + file + " 3"), "white");
    EXPECT_EQ(other.ask("move_history"), "black A1\nwhite E5");
    EXPECT_EQ(other.say("undo"), "=");
    EXPECT_EQ(other.ask("last_move"), "white E5");
}

TEST(GtpSgf, AFileThatCannotBeReadLeavesTheGame) {
    const tests::TemporaryFolder scratch;
    const auto file = (scratch.path() / "bad.sgf").string();
    GtpGuest guest;
    guest.say("play b e5");
    const auto before = guest.ask("showboard");
    EXPECT_TRUE(guest.say("loadsgf " + file).starts_with("? "));
    EXPECT_TRUE(guest.say("loadsgf").starts_with("? "));
    for (const auto* bad : {"", "(;GM[1]", "(;SZ[9];B[aa];W[aa])", "(;SZ[99];B[aa])", "\0\xff("}) {
        engine::write_file(file, bad);
        EXPECT_TRUE(guest.say("loadsgf " + file).starts_with("? ")) << bad;
        EXPECT_EQ(guest.ask("showboard"), before) << bad;
        EXPECT_EQ(guest.ask("move_history"), "black E5");
    }
}

TEST(GtpSgf, AFailedWriteKeepsTheOldFile) {
    const tests::TemporaryFolder scratch;
    const auto file = (scratch.path() / "old.sgf").string();
    GtpGuest guest;
    EXPECT_EQ(guest.say("printsgf " + file), "=");
    const auto old = engine::read_file(file);
    guest.say("play b e5");
    // Below a file there can be no other, whoever asks.
    EXPECT_TRUE(guest.say("printsgf " + file + "/below.sgf").starts_with("? "));
    EXPECT_TRUE(guest.say("printsgf " + scratch.path().string()).starts_with("? "));
    EXPECT_EQ(engine::read_file(file), old);
    EXPECT_EQ(guest.ask("last_move"), "black E5");
}

}  // namespace protocols
