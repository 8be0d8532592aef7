// Records of self-play games: what is written is read again, and damage costs only what it hit.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/base/random.h"
#include "selfplay/records/segment.h"
#include "tests/temporary_folder.h"

namespace selfplay::records {
namespace {

constexpr std::array<engine::Move, 3> three_moves{engine::Move{5}, engine::Move{17},
                                                  engine::Move{300}};

Game some_game(std::uint64_t seed) {
    engine::Random random(seed);
    Game game;
    game.game = "go";
    game.start = "9/9/9/9/9/9/9/9/9 b";
    game.steps = seed;
    game.ending = Ending::resigned;
    game.outcome = engine::Outcome::second_wins;
    game.lead = -3.5f;
    for (int i = 0; i < 81; ++i)
        game.owners.push_back(static_cast<std::int8_t>(random.below(3) - 1));
    for (int i = 0; i < 60; ++i) {
        const std::array<float, 3> policy{0.25f, 0.75f, 0.0f};
        const bool teaches = i % 4 == 0;
        game.add(
            three_moves[1], static_cast<float>(random.below(2001) - 1000) / 1000,
            teaches ? 150u : 50u,
            teaches ? std::span<const engine::Move>(three_moves) : std::span<const engine::Move>(),
            policy);
        game.turns.back().draws = static_cast<float>(i) / 100;
    }
    return game;
}

TEST(Records, AGameComesBackAsItWas) {
    auto game = some_game(1);
    game.by_rollouts = true;
    const auto back = from_bytes(to_bytes(game));
    EXPECT_TRUE(back.by_rollouts);
    EXPECT_EQ(back.game, game.game);
    EXPECT_EQ(back.start, game.start);
    EXPECT_EQ(back.owners, game.owners);
    EXPECT_EQ(back.outcome, game.outcome);
    EXPECT_EQ(back.ending, game.ending);
    EXPECT_EQ(back.lead, game.lead);
    EXPECT_EQ(back.shares, game.shares);
    ASSERT_EQ(back.turns.size(), game.turns.size());
    for (std::size_t i = 0; i < game.turns.size(); ++i) {
        EXPECT_EQ(back.turns[i].move, game.turns[i].move);
        EXPECT_NEAR(back.turns[i].value, game.turns[i].value, 0.0006);
        EXPECT_NEAR(back.turns[i].draws, game.turns[i].draws, 0.0006);
        EXPECT_EQ(back.turns[i].simulations, game.turns[i].simulations);
        EXPECT_EQ(back.policy(back.turns[i]).size(), i % 4 == 0 ? 2u : 0u);
    }
}

TEST(Records, PolicyTargetsLeaveOutWhatRoundsToNothing) {
    Game game;
    const std::array<float, 3> policy{0.5f, 1e-6f, 0.499999f};
    game.add(three_moves[0], 0, 100, three_moves, policy);
    const auto shares = game.policy(game.turns[0]);
    ASSERT_EQ(shares.size(), 2u);
    EXPECT_EQ(shares[0].move, three_moves[0]);
    EXPECT_EQ(shares[1].move, three_moves[2]);
    EXPECT_NEAR(shares[0].share, 32768, 1);
}

TEST(Records, ListsThatDoNotFitAreRefused) {
    auto game = some_game(1);
    game.shares.pop_back();
    EXPECT_THROW(from_bytes(to_bytes(game)), engine::Error);
    EXPECT_THROW(from_bytes("\xff\xff\xff"), engine::Error);
}

TEST(Segment, HoldsManyFramesOfGames) {
    const std::array<Game, 2> first{some_game(1), some_game(2)};
    const std::array<Game, 1> second{some_game(3)};
    const auto segment = unpack(pack(first) + pack(second));
    EXPECT_EQ(segment.damage, "");
    ASSERT_EQ(segment.games.size(), 3u);
    for (std::uint64_t i = 0; i < 3; ++i) EXPECT_EQ(segment.games[i].steps, i + 1);
}

TEST(Segment, EveryCutLeavesTheFramesBeforeIt) {
    const std::array<Game, 1> one{some_game(1)}, two{some_game(2)};
    const auto first = pack(one), both = first + pack(two);
    for (std::size_t cut = 4; cut < both.size(); ++cut) {
        const auto segment = unpack(std::string_view(both).substr(0, cut));
        EXPECT_EQ(segment.games.size(), cut < first.size() ? 0u : 1u) << cut;
        EXPECT_EQ(segment.damage.empty(), cut == first.size()) << cut;
        EXPECT_EQ(segment.sound_bytes, cut < first.size() ? 0u : first.size()) << cut;
    }
}

// A bit that zstd leaves unused may flip without harm; none may change what is read.
TEST(Segment, NoFlippedBitChangesAGame) {
    const std::array<Game, 1> one{some_game(1)};
    const auto sound = pack(one);
    const auto as_written = unpack(sound).games;
    for (std::size_t at = 4; at < sound.size(); at += 7) {
        auto bytes = sound;
        bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
        const auto segment = unpack(bytes);
        if (segment.damage.empty())
            EXPECT_EQ(segment.games, as_written) << at;
        else
            EXPECT_TRUE(segment.games.empty()) << at;
    }
}

TEST(Segment, RefusesOtherFiles) {
    EXPECT_THROW(unpack("PK\x03\x04 something else"), engine::Error);
    EXPECT_TRUE(unpack("").games.empty());
}

TEST(Archive, AppendsAcrossRestarts) {
    const tests::TemporaryFolder folder;
    for (std::uint64_t i = 1; i <= 3; ++i) {
        Archive archive(folder.path() / "games");
        EXPECT_EQ(archive.damage(), "");
        const std::array<Game, 1> game{some_game(i)};
        archive.append(game);
    }
    const Archive archive(folder.path() / "games");
    ASSERT_EQ(archive.segments().size(), 1u);
    const auto segment = unpack(engine::read_file(archive.segments()[0]));
    ASSERT_EQ(segment.games.size(), 3u);
    EXPECT_EQ(segment.games[2].steps, 3u);
}

TEST(Archive, CutsATornEndOffAndGoesOn) {
    const tests::TemporaryFolder folder;
    const std::array<Game, 1> game{some_game(1)};
    std::filesystem::path path;
    {
        Archive archive(folder.path());
        archive.append(game);
        path = archive.segments().at(0);
    }
    const auto sound = std::filesystem::file_size(path);
    const auto torn = pack(game);
    engine::append_file(path, torn.substr(0, torn.size() / 2));
    Archive archive(folder.path());
    EXPECT_NE(archive.damage().find(path.string()), std::string::npos);
    EXPECT_EQ(std::filesystem::file_size(path), sound);
    archive.append(game);
    const auto segment = unpack(engine::read_file(path));
    EXPECT_EQ(segment.games.size(), 2u);
    EXPECT_EQ(segment.damage, "");
}

TEST(Archive, KeepsTheNewestSegments) {
    const tests::TemporaryFolder folder;
    const std::array<Game, 1> game{some_game(1)};
    for (const auto* name : {"000001.games", "000002.games", "000009.games", "notes.games"})
        engine::write_file(folder.path() / name, pack(game));
    const Archive archive(folder.path());
    ASSERT_EQ(archive.segments().size(), 3u);
    archive.keep(std::filesystem::file_size(archive.segments()[0]) * 2);
    ASSERT_EQ(archive.segments().size(), 2u);
    EXPECT_EQ(archive.segments()[0].filename(), "000002.games");
    archive.keep(0);
    EXPECT_EQ(archive.segments().size(), 1u);
}

TEST(Archive, AFolderThatCannotBeIsAnError) {
    EXPECT_THROW(Archive("/dev/null/games"), engine::Error);
}

}  // namespace
}  // namespace selfplay::records
