// Self-play alone: what was asked for is in the archive, and a fault leaves what was written.
#include "selfplay/training/self_play.h"

#include <gtest/gtest.h>

#include <atomic>

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/games.h"
#include "tests/selfplay/training/play.h"
#include "tests/temporary_folder.h"

namespace selfplay::training {
namespace {

using Go = go::Go;

SelfPlaySettings two_threads() {
    SelfPlaySettings settings;
    settings.actors = small_settings();
    settings.threads = 2;
    return settings;
}

std::vector<records::Game> written(const records::Archive& archive) {
    std::vector<records::Game> games;
    for (const auto& path : archive.segments())
        for (auto& game : records::unpack(engine::read_file(path)).games)
            games.push_back(std::move(game));
    return games;
}

SelfPlayProgress play(const SelfPlaySettings& settings, records::Archive& archive,
                      Actor<Go>::Source network, const std::stop_token& stop = {}) {
    return SelfPlay<Go>(settings, network, 3, archive).run(stop, [](const auto&) {});
}

TEST(SelfPlay, WritesEveryGameThatWasAskedFor) {
    const tests::TemporaryFolder folder;
    records::Archive archive(folder.path());
    auto settings = two_threads();
    settings.games = 13;
    const auto progress = play(settings, archive, even<Go>());
    const auto games = written(archive);
    ASSERT_EQ(games.size(), 13u);
    EXPECT_EQ(progress.games, 13u);
    std::uint64_t positions = 0;
    for (const auto& game : games) positions += game.turns.size();
    EXPECT_EQ(progress.positions, positions);
    EXPECT_GT(progress.taught, 0u);
    EXPECT_GE(progress.evaluations, positions);
}

TEST(SelfPlay, ALaterRunPlaysOtherGames) {
    const tests::TemporaryFolder folder, other;
    records::Archive archive(folder.path()), again(other.path());
    auto settings = two_threads();
    settings.threads = 1;
    settings.games = 4;
    play(settings, archive, even<Go>());
    play(settings, again, even<Go>());
    const auto first = written(archive);
    EXPECT_EQ(first, written(again));
    play(settings, archive, even<Go>());
    const auto both = written(archive);
    ASSERT_EQ(both.size(), 8u);
    for (std::size_t i = 4; i < 8; ++i)
        for (const auto& game : first) EXPECT_NE(both[i].turns, game.turns);
}

TEST(SelfPlay, EndsWithEnoughPositions) {
    const tests::TemporaryFolder folder;
    records::Archive archive(folder.path());
    auto settings = two_threads();
    settings.positions = 500;
    EXPECT_GE(play(settings, archive, even<Go>()).positions, 500u);
}

TEST(SelfPlay, EndsWhenAskedTo) {
    const tests::TemporaryFolder folder;
    records::Archive archive(folder.path());
    std::stop_source stop;
    stop.request_stop();
    play(two_threads(), archive, even<Go>(), stop.get_token());
}

TEST(SelfPlay, RefusesAFolderOfAnotherGame) {
    const tests::TemporaryFolder folder;
    records::Archive archive(folder.path());
    auto settings = two_threads();
    settings.games = 2;
    play(settings, archive, even<Go>());
    EXPECT_THROW(SelfPlay<chess::Chess>(settings, even<chess::Chess>(), 0, archive), engine::Error);
}

TEST(SelfPlay, AFaultOfTheNetworkIsRethrown) {
    const tests::TemporaryFolder folder;
    records::Archive archive(folder.path());
    std::atomic<int> asked = 0;
    const auto network = std::make_shared<Oracle<Go>>([&](const search::Query<Go>&) {
        if (++asked > 5000) engine::fail("no number");
    });
    EXPECT_THROW(play(two_threads(), archive, network), engine::Error);
    EXPECT_FALSE(written(archive).empty());
}

}  // namespace
}  // namespace selfplay::training
