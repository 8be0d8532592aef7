// The real thing: our GTP front end against GNU Go, whose every command and answer is foreign.
#include <gtest/gtest.h>

#include <filesystem>

#include "selfplay/make_player.h"
#include "selfplay/match.h"

namespace selfplay {
namespace {

using namespace std::chrono_literals;

bool installed(const std::string& program) {
    for (const auto* folder : {"/usr/games", "/usr/bin", "/usr/local/bin"})
        if (std::filesystem::exists(std::filesystem::path(folder) / program)) return true;
    return false;
}

TEST(GnuGo, TenGamesWithoutAFault) {
    if (!installed("gnugo")) GTEST_SKIP() << "gnugo is not installed";
    MatchSettings settings;
    settings.go.size = 9;
    settings.players[0].command = SANBAN_EXECUTABLE " gtp --simulations 50";
    settings.players[1].command =
        "gnugo --mode gtp --level 1 --chinese-rules --capture-all-dead --positional-superko";
    settings.agree_on_dead = false;
    settings.games = 10;
    settings.concurrency = 2;
    settings.openings.random_plies = 2;
    settings.rules.move_timeout = settings.rules.command_timeout = 30s;
    Match match(settings, [&](int engine, std::stop_token token) {
        return make_player(settings.players[static_cast<std::size_t>(engine)], settings.game, 30s,
                           std::move(token));
    });
    match.run({}, [](const GameRecord& record, const Standing&) {
        EXPECT_FALSE(record.by_fault()) << record.reason << ": " << record.detail;
        EXPECT_NE(record.reason, "move limit");
    });
    EXPECT_EQ(match.standing().tally.games(), 10);
}

}  // namespace
}  // namespace selfplay
