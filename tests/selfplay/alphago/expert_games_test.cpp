// Games of others as lessons: what is kept, what is left out, and the records made of them.
#include "selfplay/alphago/expert_games.h"

#include <gtest/gtest.h>

#include <map>

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "tests/temporary_folder.h"

namespace selfplay::alphago {
namespace {

const Say silent = [](const std::string&) {};

std::string sgf(int moves, const std::string& facts = "") {
    std::string text = "(;SZ[5]KM[6.5]" + facts;
    for (int i = 0; i < moves; ++i) {
        text += i % 2 == 0 ? ";B[" : ";W[";
        text += static_cast<char>('a' + i % 5);
        text += static_cast<char>('a' + i / 5);
        text += ']';
    }
    return text + ")\n";
}

TEST(ExpertGames, LeavesOutWhatTeachesNoEvenGame) {
    const tests::TemporaryFolder folder;
    std::string text;
    for (int i = 0; i < 20; ++i) text += sgf(12);
    text += sgf(12, "HA[2]AB[ed][ee]");
    text += "(;SZ[5];W[aa];B[bb];W[cc])\n";
    text += sgf(4);
    text += "(;SZ[9];B[aa];W[bb])\n";
    text += "(;SZ[5];B[aa];W[aa])\n";
    engine::write_file(folder.path() / "games.sgfs", text);
    const std::vector<std::filesystem::path> paths{folder.path()};
    const auto games = read_expert_games(paths, {5, 6}, silent);
    EXPECT_EQ(games.counts.games, 25u);
    EXPECT_EQ(games.counts.kept, 20u);
    EXPECT_EQ(games.counts.positions, 240u);
    EXPECT_EQ(games.counts.handicap, 2u);
    EXPECT_EQ(games.counts.brief, 1u);
    EXPECT_EQ(games.counts.other_size, 1u);
    EXPECT_EQ(games.counts.broken, 1u);
    EXPECT_EQ(games.lessons.size(), 18u);
    EXPECT_EQ(games.held_out.size(), 2u);
    EXPECT_EQ(games.lessons[0].moves.size(), 12u);
    EXPECT_EQ(read_expert_games(paths, {5, 6, 10}, silent).counts.kept, 10u);
    EXPECT_THROW(read_expert_games(paths, {13, 6}, silent), engine::Error);
}

TEST(ExpertGames, PassesAtTheEndTeachNothing) {
    const tests::TemporaryFolder folder;
    std::string text;
    for (int i = 0; i < 10; ++i) text += "(;SZ[5];B[aa];W[bb];B[cc];W[];B[])\n";
    engine::write_file(folder.path() / "games.sgf", text);
    const std::vector<std::filesystem::path> paths{folder.path() / "games.sgf"};
    EXPECT_EQ(read_expert_games(paths, {5, 3}, silent).lessons[0].moves.size(), 3u);
}

TEST(ExpertGames, NoSuchFolder) {
    const std::vector<std::filesystem::path> paths{"nowhere"};
    EXPECT_THROW(sgf_files(paths), engine::Error);
}

TEST(ExpertPositions, EachPositionOnce) {
    const std::vector<ExpertGame> games{{5, {}, {7, 8, 9}}, {5, {}, {10}}, {5, {}, {11, 12}}};
    const ExpertPositions positions(games);
    ASSERT_EQ(positions.count(), 6u);
    std::vector<std::uint16_t> moves;
    for (std::uint64_t i = 0; i < 6; ++i)
        moves.push_back(positions[i].game->moves[positions[i].turn]);
    EXPECT_EQ(moves, (std::vector<std::uint16_t>{7, 8, 9, 10, 11, 12}));
    engine::Random random(1);
    std::map<int, int> drawn;
    for (int i = 0; i < 6000; ++i) {
        const auto place = positions.draw(random);
        ++drawn[place.game->moves[place.turn]];
    }
    for (const auto& [move, count] : drawn) EXPECT_NEAR(count, 1000, 150) << move;
    EXPECT_EQ(drawn.size(), 6u);
}

TEST(ExpertPositions, ARecordTeachesTheMovePlayed) {
    const go::Go start(5);
    const std::vector<ExpertGame> games{
        {5, {}, {start.move_at({2, 2}).code, start.move_at({1, 1}).code}}};
    const auto record = record_of({&games[0], 1});
    ASSERT_EQ(record.turns.size(), 2u);
    EXPECT_EQ(record.turns[0].share_count, 0u);
    const auto shares = record.policy(record.turns[1]);
    ASSERT_EQ(shares.size(), 1u);
    EXPECT_EQ(shares[0].move, start.move_at({1, 1}));
    EXPECT_EQ(go::Go::from_text(record.start).size(), 5);
}

}  // namespace
}  // namespace selfplay::alphago
