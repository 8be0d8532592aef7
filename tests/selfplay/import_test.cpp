// Games by others as records: who won, how it ended, and what every turn teaches.
#include "selfplay/records/import.h"

#include <gtest/gtest.h>

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/games.h"
#include "selfplay/training/lesson.h"
#include "tests/temporary_folder.h"

namespace selfplay::records {
namespace {

struct Imported {
    ImportCounts counts;
    std::vector<Game> games;
};

Imported import_text(const std::string& name, const std::string& text) {
    const tests::TemporaryFolder folder;
    engine::write_file(folder.path() / name, text);
    Imported imported;
    imported.counts = import_games(texts_behind(folder.path()), [&](std::span<const Game> games) {
        imported.games.insert(imported.games.end(), games.begin(), games.end());
    });
    return imported;
}

TEST(Import, Chess) {
    const auto [counts, games] = import_text("games.pgn", R"(
[Result "0-1"]
1. f3 e5 2. g4 Qh4# 0-1

[Result "1-0"]
1. e4 c5 1-0

[Result "1/2-1/2"]
1. d4 d5 1/2-1/2

[Result "*"]
1. d4 *

[Result "1-0"]
1. e4 e5 2. Ke3 1-0

[Result "1-0"]
[SetUp "1"]
[FEN "4k3/8/8/8/8/8/8/R3K3 w - - 0 1"]
1. Ra8+ 1-0
)");
    EXPECT_EQ(counts.kept, 4u);
    EXPECT_EQ(counts.unfinished, 1u);
    EXPECT_EQ(counts.broken, 1u);
    ASSERT_EQ(games.size(), 4u);
    EXPECT_EQ(games[0].outcome, engine::Outcome::second_wins);
    EXPECT_EQ(games[0].ending, Ending::rules);
    EXPECT_EQ(games[1].outcome, engine::Outcome::first_wins);
    EXPECT_EQ(games[1].ending, Ending::resigned);
    EXPECT_EQ(games[2].outcome, engine::Outcome::draw);
    EXPECT_EQ(games[2].ending, Ending::agreed);
    EXPECT_EQ(from_bytes(to_bytes(games[2])), games[2]);
    const auto last = training::position_of<chess::Chess>(games[3], 1);
    EXPECT_EQ(last.to_text(), "R3k3/8/8/8/8/8/8/4K3 b - - 1 1");
}

// Before the mating move: that move and no other, and a win.
TEST(Import, EveryTurnTeachesItsMove) {
    const auto games = import_text("game.pgn", "1. f3 e5 2. g4 Qh4# 0-1\n").games;
    ASSERT_EQ(games.size(), 1u);
    const auto& encoding = engine::find_encoding<chess::Chess>("alphazero");
    training::Lesson lesson;
    training::write_lesson(games[0], 3, encoding, 0, {}, lesson);
    const auto position = training::position_of<chess::Chess>(games[0], 3);
    const auto mate = position.move_from_text("d8h4");
    ASSERT_TRUE(mate);
    float sum = 0;
    for (std::size_t i = 0; i < lesson.moves.size(); ++i) {
        sum += lesson.policy[i];
        const bool taught = lesson.moves[i] == encoding.policy_index(position, *mate);
        EXPECT_EQ(lesson.policy[i] > 0, taught);
    }
    EXPECT_EQ(sum, 1);
    EXPECT_EQ(lesson.value, 1);
    EXPECT_FALSE(lesson.scored);
}

TEST(Import, Go) {
    const auto [counts, games] = import_text("games.sgf",
                                             "(;SZ[9]KM[5.5]RE[B+R];B[ee];W[cc];B[gg])"
                                             "(;SZ[9]RE[W+2.5];B[ee];W[cc];B[];W[])"
                                             "(;SZ[9]HA[2]AB[cc][gg]RE[W+R];W[ee];B[ec])"
                                             "(;SZ[9]RE[B+R];B[ee];B[cc])"
                                             "(;SZ[9]RE[?];B[ee];W[cc])"
                                             "(;SZ[9]RE[B+R];B[ee];W[ee])");
    EXPECT_EQ(counts.kept, 2u);
    EXPECT_EQ(counts.uneven, 2u);
    EXPECT_EQ(counts.unfinished, 1u);
    EXPECT_EQ(counts.broken, 1u);
    ASSERT_EQ(games.size(), 2u);
    EXPECT_EQ(games[0].outcome, engine::Outcome::first_wins);
    EXPECT_EQ(go::Go::from_text(games[0].start).komi().points(), 5.5);
    EXPECT_EQ(games[1].outcome, engine::Outcome::second_wins);
    EXPECT_EQ(games[1].ending, Ending::rules);
    EXPECT_EQ(games[1].turns.size(), 4u);
}

TEST(Import, Shogi) {
    const auto [counts, games] = import_text("games.csa",
                                             "V2.2\nPI\n+\n+7776FU\n-3334FU\n%TORYO\n/\n"
                                             "V2.2\nPI\n+\n+7776FU\n%CHUDAN\n");
    EXPECT_EQ(counts.kept, 1u);
    EXPECT_EQ(counts.unfinished, 1u);
    ASSERT_EQ(games.size(), 1u);
    // Black is to move and gives up.
    EXPECT_EQ(games[0].outcome, engine::Outcome::second_wins);
    EXPECT_EQ(games[0].ending, Ending::resigned);
    EXPECT_EQ(games[0].turns.size(), 2u);
}

TEST(Import, FindsTextsBelowAFolderAndNoOthers) {
    const tests::TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "below");
    for (const char* name : {"b.pgn", "a.sgf", "below/c.kif", "readme.txt", "000001.games"})
        engine::write_file(folder.path() / name, "");
    const auto files = texts_behind(folder.path());
    ASSERT_EQ(files.size(), 3u);
    EXPECT_EQ(files[0].filename(), "a.sgf");
    EXPECT_EQ(texts_behind(folder.path() / "readme.txt").size(), 0u);
    EXPECT_EQ(texts_behind("not/there.pgn").size(), 1u);  // reading it says what is wrong
    EXPECT_THROW(import_games(texts_behind("not/there.pgn"), [](auto) {}), engine::Error);
}

}  // namespace
}  // namespace selfplay::records
