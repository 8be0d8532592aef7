#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "engine/base/error.h"
#include "engine/go/sgf.h"
#include "engine/go/sgf_collection.h"

namespace go::sgf {

namespace {

namespace fs = std::filesystem;

Record record(std::string_view text, int most_moves = 1 << 20) {
    return main_line(parse(text).front(), most_moves);
}

std::string why_refused(std::string_view text) {
    try {
        record(text);
    } catch (const engine::Error& error) {
        return error.what();
    }
    return "not refused";
}

double komi(std::string_view text) {
    return record(fmt::format("(;KM[{}])", text)).end.komi().points();
}

std::optional<Player> stone(const Go& game, std::string_view vertex) {
    return game.at(*point_from_vertex(vertex, game.size()));
}

constexpr auto black = Player::first, white = Player::second;

}  // namespace

TEST(SgfRecord, MovesStonesAndFacts) {
    const auto game = record("(;SZ[9]KM[5.5]RU[Japanese]RE[W+R];B[ee];W[ac];B[];W[tt];W[ia])");
    EXPECT_EQ(game.end.size(), 9);
    EXPECT_EQ(game.end.komi().points(), 5.5);
    EXPECT_EQ(game.end.rules().scoring, Scoring::territory);
    EXPECT_EQ(game.result, "W+R");
    ASSERT_EQ(game.turns.size(), 5u);
    EXPECT_EQ(game.turns[2].move, Go::pass);
    EXPECT_EQ(game.turns[3].move, Go::pass);
    EXPECT_EQ(game.turns[4].player, white);
    EXPECT_EQ(stone(game.end, "E5"), black);
    EXPECT_EQ(stone(game.end, "A7"), white);
    EXPECT_EQ(stone(game.end, "J9"), white);
}

TEST(SgfRecord, OnlyTheMainLine) {
    const auto game = record("(;SZ[9](;B[aa](;W[bb])(;W[cc]))(;B[dd]))");
    EXPECT_EQ(game.turns.size(), 2u);
    EXPECT_EQ(stone(game.end, "B8"), white);
}

TEST(SgfRecord, StopsBeforeAMove) {
    constexpr std::string_view text = "(;SZ[9];AB[aa];B[bb];W[cc];B[dd])";
    EXPECT_TRUE(record(text, 0).turns.empty());
    EXPECT_EQ(stone(record(text, 0).end, "A9"), black);
    EXPECT_EQ(record(text, 2).turns.size(), 2u);
    EXPECT_FALSE(stone(record(text, 2).end, "D6"));
}

TEST(SgfRecord, SetUpAndWhoMoves) {
    const auto game = record("(;SZ[9]AB[aa:cb][ee]AW[gg]AE[bb])");
    EXPECT_EQ(stone(game.start, "A9"), black);
    EXPECT_EQ(stone(game.start, "C8"), black);
    EXPECT_FALSE(stone(game.start, "B8"));
    EXPECT_EQ(stone(game.start, "G3"), white);
    EXPECT_EQ(record("(;SZ[9]AB[cc])").start.to_play(), white);
    EXPECT_EQ(record("(;SZ[9]AB[cc]PL[B])").start.to_play(), black);
    EXPECT_EQ(record("(;SZ[9]AB[cc];B[dd])").start.to_play(), black);
}

TEST(SgfRecord, SetUpInTheMiddleStartsAnew) {
    const auto game = record("(;SZ[9];B[aa];W[bb];AE[aa]AB[cc]PL[W];W[dd])");
    EXPECT_EQ(game.moves_before, 2);
    EXPECT_EQ(game.turns.size(), 1u);
    EXPECT_FALSE(stone(game.start, "A9"));
    EXPECT_EQ(stone(game.start, "B8"), white);
    EXPECT_EQ(game.start.to_play(), white);
    EXPECT_EQ(why_refused("(;SZ[9];B[aa];W[bb];AE[aa];B[bb])"),
              "move 3: B[bb] is illegal: occupied");
}

TEST(SgfRecord, Handicap) {
    const auto given = record("(;HA[2]AB[dd][pp];W[dp])");
    EXPECT_EQ(given.start.handicap(), 2);
    EXPECT_TRUE(given.notes.empty());
    const auto absent = record("(;HA[4];W[cc])");
    EXPECT_EQ(stone(absent.start, "D4"), black);
    EXPECT_EQ(stone(absent.start, "Q16"), black);
    EXPECT_EQ(absent.notes.size(), 1u);
    EXPECT_FALSE(stone(record("(;HA[2];B[dd];B[pp];W[cc])").start, "D4"));
}

TEST(SgfRecord, KomiOfAllKinds) {
    EXPECT_EQ(komi("6.5"), 6.5);
    EXPECT_EQ(komi("-7"), -7);
    EXPECT_EQ(komi("6,5"), 6.5);
    EXPECT_EQ(komi("0"), 0);
    EXPECT_EQ(komi("750"), 7.5);
    EXPECT_EQ(komi("375"), 7.5);
    EXPECT_EQ(komi("3.75"), 7.5);
    EXPECT_EQ(komi("0.99"), 1);
    EXPECT_EQ(komi("six"), 7.5);
    EXPECT_EQ(komi("1e300"), 7.5);
    EXPECT_EQ(komi("nan"), 7.5);
    EXPECT_EQ(record("(;RU[Japanese])").end.komi().points(), 6.5);
    EXPECT_EQ(record("(;KM[375])").notes, std::vector<std::string>{"KM[375]: komi 7.5"});
    EXPECT_TRUE(record("(;KM[7.50])").notes.empty());
}

TEST(SgfRecord, RefusalsSayWhichMoveAndWhy) {
    EXPECT_EQ(why_refused("(;SZ[9];B[aa];W[aa])"), "move 2: W[aa] is illegal: occupied");
    EXPECT_EQ(why_refused("(;SZ[9];B[ab];W[dd];B[ba];W[aa])"), "move 4: W[aa] is illegal: suicide");
    EXPECT_EQ(why_refused("(;SZ[9];B[ba];W[ca];B[ab];W[bb];B[cb];W[da];B[db];W[aa])"),
              "not refused");
    EXPECT_EQ(why_refused("(;SZ[9];B[jj])"), "move 1: B[jj] is no point of the board");
    EXPECT_EQ(why_refused("(;SZ[25];B[tt])"), "not refused");
    EXPECT_EQ(why_refused("(;SZ[9];B[D4])"), "move 1: B[D4] is no point of the board");
    EXPECT_EQ(why_refused("(;SZ[9];B[aa][bb])"), "move 1: B with several points");
    EXPECT_EQ(why_refused("(;SZ[9]AB[ab][ba]AW[aa])"),
              "move 1: the set-up leaves a chain without liberty");
    EXPECT_EQ(why_refused("(;SZ[19:13])"), "SZ[19:13]: the board is not square");
    EXPECT_EQ(why_refused("(;SZ[26])"), "SZ[26]: the size must lie in 2..25");
    EXPECT_EQ(why_refused("(;SZ[19:19])"), "not refused");
    EXPECT_EQ(why_refused("(;GM[2])"), "GM[2] is not Go, which is GM[1]");
}

TEST(SgfRecord, KoIsRefused) {
    constexpr std::string_view ko =
        "(;SZ[9];B[ba];W[ca];B[ab];W[db];B[bc];W[cc];B[cb];W[bb];B[cb])";
    EXPECT_EQ(why_refused(ko), "move 9: B[cb] is illegal: ko");
}

TEST(SgfRecord, MainLinesWithoutEndAreRefused) {
    std::string passes, set_ups;
    for (int i = 0; i < 70000; ++i) passes += i % 2 == 0 ? ";B[]" : ";W[]";
    for (int i = 0; i < 2000; ++i) set_ups += i % 2 == 0 ? ";AB[aa]" : ";AE[aa]";
    EXPECT_EQ(why_refused("(;SZ[9]" + passes + ")"), "move 65537: more than 65536 moves");
    EXPECT_EQ(record("(;SZ[9]" + passes + ")", 100).turns.size(), 100u);
    EXPECT_EQ(why_refused("(;SZ[9]" + set_ups + ")"), "move 1: more than 1024 set-ups");
}

TEST(SgfRecord, TreeOfReadsBackTheSame) {
    auto game = record("(;SZ[13]HA[2]AB[dd][jj]KM[375.0]RU[new-zealand];W[cc];B[];B[dj];W[jd])");
    EXPECT_EQ(game.start.komi().points(), 375);
    const auto tree = tree_of(game.start, game.turns, "B+3.5", {{"PB", {"a]b"}}}, {"", "pass!"});
    EXPECT_EQ(tree.nodes[2].value("C"), "pass!");
    const auto again = main_line(parse(to_text(tree)).front());
    EXPECT_EQ(again.start, game.start);
    EXPECT_EQ(again.end, game.end);
    EXPECT_EQ(again.turns, game.turns);
    EXPECT_EQ(again.result, "B+3.5");
    EXPECT_TRUE(again.notes.empty());
}

TEST(SgfRecord, RootAsOthersReadIt) {
    EXPECT_EQ(to_text(tree_of(Go(9), {{black, Go(9).move_at({4, 4})}, {white, Go::pass}}, "B+R")),
              "(;GM[1]FF[4]CA[UTF-8]AP[sanban:" SANBAN_VERSION
              "]SZ[9]RU[Chinese]KM[7.5]RE[B+R];B[ee];W[])\n");
}

namespace {

// The shared data, where there is any.
class SharedRecords : public testing::Test {
   protected:
    void SetUp() override {
        if (!fs::exists(folder)) GTEST_SKIP() << "no shared data in " << folder;
    }

    static fs::path find_folder() {
        const char* const named = std::getenv("SANBAN_SHARED");
        return named ? fs::path(named) / "data" : fs::path(SANBAN_SOURCE_DIR) / "../shared/data";
    }

    const fs::path folder = find_folder();
};

}  // namespace

TEST_F(SharedRecords, CollectionsReplayOrAreRefusedForAReason) {
    int collections = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (!entry.path().string().ends_with(".sgfs.gz")) continue;
        ++collections;
        const auto report = check_collection(
            entry.path(),
            [](const Refusal& refusal) {
                EXPECT_NE(refusal.message.find("move "), std::string::npos) << refusal.message;
                EXPECT_NE(refusal.message.find(".sgfs.gz, game "), std::string::npos);
            },
            1000);
        EXPECT_EQ(report.games, 1000) << entry.path();
        EXPECT_LE(report.refused(), 10) << entry.path();
    }
    EXPECT_GE(collections, 10);
}

TEST_F(SharedRecords, UntouchedOriginalsSurviveARoundTrip) {
    const auto unpacked = fs::path(testing::TempDir()) / "sgf_originals";
    fs::create_directories(unpacked);
    const auto archive = folder / "go9/ogs/originals-sample-500.tar.gz";
    const auto command = fmt::format("tar -xzf '{}' -C '{}'", archive.string(), unpacked.string());
    ASSERT_EQ(std::system(command.c_str()), 0);
    int files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(unpacked)) {
        if (!entry.is_regular_file()) continue;
        const auto tree = parse(read_file(entry.path())).front();
        EXPECT_EQ(parse(to_text(tree)).front(), tree) << entry.path();
        EXPECT_NO_THROW(main_line(tree)) << entry.path();
        ++files;
    }
    EXPECT_EQ(files, 500);
    fs::remove_all(unpacked);
}

}  // namespace go::sgf
