// Lines of USI, and the games, openings and mate problems in ../shared.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/shogi/csa.h"
#include "engine/shogi/movegen.h"
#include "engine/shogi/sfen.h"
#include "engine/shogi/usi.h"
#include "engine/shogi/usi_game.h"
#include "tests/engine/shogi_data.h"

namespace shogi {
namespace {

TEST(ShogiUsi, Moves) {
    for (const char* text : {"7g7f", "8h2b+", "P*5e", "R*1a", "9i1a+"})
        EXPECT_EQ(to_usi(*parse_usi_move(text)), text);
    for (const char* text : {"", "7g7", "7g7fx", "7g7f++", "0a1b", "1a1j", "K*5e", "p*5e", "P*5e+",
                             "1a1a", "resign", "win"})
        EXPECT_FALSE(parse_usi_move(text)) << text;
}

TEST(ShogiUsi, Games) {
    const auto record = parse_usi_game("position startpos moves 7g7f 3c3d 8h2b+\r\n");
    EXPECT_EQ(to_usi_game(record), "startpos moves 7g7f 3c3d 8h2b+");
    constexpr auto endgame = "sfen 8k/9/7S1/9/9/9/9/9/9 b 2G 1";
    EXPECT_EQ(to_usi_game(parse_usi_game(endgame)), endgame);
    try {
        parse_usi_game("startpos moves 7g7f 7f7e");
        FAIL();
    } catch (const engine::Error& error) {
        EXPECT_STREQ(error.what(), "move 2 (7f7e) is illegal");
    }
    EXPECT_THROW(parse_usi_game("startpos moves 7g7f x"), engine::Error);
    EXPECT_THROW(parse_usi_game("moves 7g7f"), engine::Error);
}

// Every line of a file, whatever stands before "startpos".
std::vector<Record> games_of(const char* path) {
    std::vector<Record> games;
    for (const auto& line : lines_of(shared_data() / "shogi" / path))
        games.push_back(parse_usi_game(std::string_view(line).substr(line.find("startpos"))));
    return games;
}

std::set<std::string> mainlines_of(const char* folder) {
    std::set<std::string> lines;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(shared_data() / "shogi" / folder))
        if (entry.path().extension() == ".csa")
            for (const auto& record : csa::parse(engine::read_file(entry.path())))
                lines.insert(to_usi_game(record));
    return lines;
}

// The USI lines there were made from the CSA files by another program.
TEST(ShogiUsi, SharedGamesAgreeWithTheirCsa) {
    if (!std::filesystem::exists(shared_data() / "shogi"))
        GTEST_SKIP() << "no ../shared/data/shogi";
    struct Source {
        const char *lines, *folder;
        std::size_t games;
    };
    for (const auto& [lines, folder, number] :
         {Source{"csa-wcsc28-apery/wcsc28.usi", "csa-wcsc28-apery", 261},
          Source{"csa-gpsshogi/gps.usi", "csa-gpsshogi", 136}}) {
        const auto from_csa = mainlines_of(folder);
        const auto games = games_of(lines);
        EXPECT_EQ(games.size(), number);
        for (const auto& game : games) EXPECT_TRUE(from_csa.contains(to_usi_game(game))) << folder;
    }
}

TEST(ShogiUsi, SharedGamesAreLegal) {
    if (!std::filesystem::exists(shared_data() / "shogi"))
        GTEST_SKIP() << "no ../shared/data/shogi";
    EXPECT_EQ(games_of("usi-lishogi-scalashogi/lishogi_prod500standard.usi").size(), 500u);
    EXPECT_EQ(games_of("csa-kif-misc/sunfish_pro.usi").size(), 9u);
    EXPECT_EQ(games_of("openings/taya36.sfen").size(), 1957u);
    const auto positions =
        lines_of(shared_data() / "shogi/openings/converted_records2016_10818.sfen");
    EXPECT_EQ(positions.size(), 10831u);
    for (const auto& line : positions) EXPECT_EQ(Shogi::from_text(line).to_text(), line);
}

bool mates_in_one(const Shogi& game) {
    const auto mate = game.forced_mate();
    return mate && mate->plies == 1;
}

TEST(ShogiUsi, SharedMatesInOne) {
    const auto mates = lines_of(shared_data() / "shogi/mate/mate-1-ply.txt"),
               near_misses = lines_of(shared_data() / "shogi/mate/no-mate-1-ply.txt");
    if (mates.empty()) GTEST_SKIP() << "no ../shared/data/shogi";
    for (const auto& line : mates) EXPECT_TRUE(mates_in_one(Shogi::from_text(line))) << line;
    for (const auto& line : near_misses) EXPECT_FALSE(mates_in_one(Shogi::from_text(line))) << line;
    EXPECT_GT(mates.size(), 1500u);
    EXPECT_GT(near_misses.size(), 1500u);
}

TEST(ShogiUsi, SharedMatesInThree) {
    const auto mates = lines_of(shared_data() / "shogi/mate/mate-3-ply.txt");
    if (mates.empty()) GTEST_SKIP() << "no ../shared/data/shogi";
    for (const auto& line : mates) {
        auto game = Shogi::from_text(line);
        const auto mate = game.forced_mate();
        ASSERT_TRUE(mate && mate->mates && mate->plies == 3) << line;
        game.play(mate->move);
        const auto mated = game.forced_mate();
        ASSERT_TRUE(mated && !mated->mates && mated->plies == 2) << line;
    }
    EXPECT_EQ(mates.size(), 1000u);
    // Two of the thousand in five are in three, as search/mate_test.cpp knows.
    int shorter = 0;
    for (const auto& line : lines_of(shared_data() / "shogi/mate/mate-5-ply.txt"))
        shorter += Shogi::from_text(line).forced_mate().has_value();
    EXPECT_EQ(shorter, 2);
}

}  // namespace
}  // namespace shogi
