#include "selfplay/match.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/go/sgf.h"
#include "selfplay/make_player.h"
#include "selfplay/time_text.h"
#include "tests/selfplay/fake_engine.h"

namespace selfplay {
namespace {

using namespace std::chrono_literals;
using testing::FakeEngine;

MatchSettings settings_for(const std::string& first, const std::string& second, int games) {
    MatchSettings settings;
    settings.go.size = 9;
    settings.players[0].command = first;
    settings.players[1].command = second;
    settings.games = games;
    settings.rules.move_timeout = settings.rules.command_timeout = 10s;
    return settings;
}

std::vector<GameRecord> play(const MatchSettings& settings, std::stop_token stop = {}) {
    std::vector<GameRecord> records;
    Match match(settings, [&](int engine, std::stop_token token) {
        return make_player(settings.players[static_cast<std::size_t>(engine)], settings.game, 10s,
                           std::move(token));
    });
    match.run(stop, [&](const GameRecord& record, const Standing&) { records.push_back(record); });
    return records;
}

TEST(Match, PlaysCountsAndAlternates) {
    const FakeEngine fake;
    const auto records = play(settings_for(fake.command(), fake.command(), 4));
    ASSERT_EQ(records.size(), 4u);
    for (const auto& record : records) {
        // Both walls stand: 36 points each, White has komi.
        EXPECT_EQ(record.score, "W+7.5");
        EXPECT_EQ(record.reason, "score");
        EXPECT_EQ(record.moves.size(), 20u);
        EXPECT_EQ(record.milliseconds.size(), 20u);
        EXPECT_EQ(record.first, record.index % 2);
        EXPECT_EQ(record.winner(), 1 - record.first);
        EXPECT_FALSE(record.by_fault());
    }
    EXPECT_EQ(records[0].names[0], "fake-play 1");
}

struct FaultCase {
    std::string mode, reason, detail;
};

class MatchFaults : public ::testing::TestWithParam<FaultCase> {};

// The faulty engine loses both games, in each with a fresh process.
TEST_P(MatchFaults, LoseTheGameNotTheMatch) {
    const FakeEngine fake;
    auto settings = settings_for(fake.command(), fake.command(GetParam().mode, "3"), 2);
    settings.rules.move_timeout = 500ms;
    const auto records = play(settings);
    ASSERT_EQ(records.size(), 2u);
    for (const auto& record : records) {
        EXPECT_EQ(record.winner(), 0) << record.detail;
        EXPECT_EQ(record.reason, GetParam().reason) << record.detail;
        EXPECT_TRUE(record.detail.starts_with("fake-" + GetParam().mode + ": ")) << record.detail;
        EXPECT_NE(record.detail.find(GetParam().detail), std::string::npos) << record.detail;
        EXPECT_EQ(record.moves.size(), record.index == 0 ? 5u : 4u);
    }
}

INSTANTIATE_TEST_SUITE_P(All, MatchFaults,
                         ::testing::Values(FaultCase{"crash", "crash", "exited with status 3"},
                                           FaultCase{"abort", "crash", "killed by signal 11 (Segm"},
                                           FaultCase{"hang", "hang", "no answer"},
                                           FaultCase{"mute", "crash", "closed its output"},
                                           FaultCase{"illegal", "illegal move", "D1: occupied"},
                                           FaultCase{"nonsense", "illegal move",
                                                     "what?: not a vertex"},
                                           FaultCase{"garbage", "protocol error", "gibberish"},
                                           FaultCase{"refuse", "protocol error", "refused genmove"},
                                           FaultCase{"endless", "protocol error", "endless line"}),
                         [](const auto& fault) { return fault.param.mode; });

TEST(Match, ResignationIsNoFault) {
    const FakeEngine fake;
    const auto records = play(settings_for(fake.command("resign", "2"), fake.command(), 1));
    ASSERT_EQ(records.size(), 1u);
    EXPECT_EQ(records[0].reason, "resignation");
    EXPECT_EQ(records[0].winner(), 1);
    EXPECT_FALSE(records[0].by_fault());
}

TEST(Match, OverstepsTheClock) {
    const FakeEngine fake;
    auto settings = settings_for(fake.command(), fake.command("slow", "2"), 1);
    settings.rules.time[1] = time_from_text("absolute 0.3");
    const auto lost = play(settings);
    EXPECT_EQ(lost.at(0).reason, "time");
    EXPECT_EQ(lost.at(0).winner(), 0);
    EXPECT_EQ(lost.at(0).moves.size(), 3u);

    settings.rules.margin = 2s;
    const auto in_time = play(settings);
    EXPECT_EQ(in_time.at(0).reason, "score");
}

TEST(Match, DeadStonesNeedBothToAgree) {
    const FakeEngine fake;
    auto settings = settings_for(fake.command("dead", "D1,D2"), fake.command("dead", "d2,D1"), 1);
    const auto agreed = play(settings);
    EXPECT_EQ(agreed.at(0).dead, (std::vector<std::string>{"D1", "D2"}));
    EXPECT_NE(agreed.at(0).score, "W+7.5");

    settings.players[1].command = fake.command("dead", "D1");
    const auto disputed = play(settings);
    EXPECT_EQ(disputed.at(0).score, "W+7.5");
    EXPECT_TRUE(disputed.at(0).dead.empty());
    EXPECT_NE(disputed.at(0).detail.find("no agreement"), std::string::npos);

    settings.agree_on_dead = false;
    settings.players[1].command = fake.command("dead", "D1,D2");
    EXPECT_EQ(play(settings).at(0).score, "W+7.5");
}

TEST(Match, MoveLimitDraws) {
    const FakeEngine fake;
    auto settings = settings_for(fake.command(), fake.command(), 1);
    settings.rules.move_limit = 7;
    const auto records = play(settings);
    EXPECT_EQ(records.at(0).reason, "move limit");
    EXPECT_EQ(records.at(0).winner(), -1);
    EXPECT_EQ(records.at(0).moves.size(), 7u);
}

TEST(Match, HandicapLetsWhiteBegin) {
    const FakeEngine fake;
    auto settings = settings_for(fake.command(), fake.command(), 1);
    settings.go.handicap = {"C3", "G7"};
    const auto records = play(settings);
    EXPECT_EQ(records.at(0).reason, "score") << records.at(0).detail;
    EXPECT_EQ(records.at(0).moves.front(), "F1");
}

TEST(Match, OpeningsArePlayedWithBothColours) {
    const FakeEngine fake;
    auto settings = settings_for(fake.command("resign", "1"), fake.command("resign", "1"), 6);
    settings.openings.random_plies = 6;
    const auto records = play(settings);
    ASSERT_EQ(records.size(), 6u);
    for (std::size_t i = 0; i < 6; i += 2) {
        EXPECT_EQ(records[i].moves, records[i + 1].moves);
        EXPECT_NE(records[i].first, records[i + 1].first);
        EXPECT_EQ(records[i].opening_moves, 6);
    }
    EXPECT_NE(records[0].moves, records[2].moves);
    EXPECT_EQ(play(settings)[0].moves, records[0].moves) << "the seed decides";
    settings.openings.seed = 2;
    EXPECT_NE(play(settings)[0].moves, records[0].moves);
}

TEST(Match, OpeningsFromSgf) {
    const FakeEngine fake;
    const auto file = fake.folder() / "book.sgf";
    engine::write_file(file,
                       "(;SZ[9];B[ee];W[cc];B[gg])(;SZ[19];B[ee];W[cc];B[gg])(;SZ[9];B[ee];W[ee])"
                       "(;SZ[9];B[cg];W[gc])");
    auto settings = settings_for(fake.command("resign", "1"), fake.command("resign", "1"), 4);
    settings.openings.file = file;
    settings.openings.plies = 2;
    const auto records = play(settings);
    std::set<std::vector<std::string>> seen;
    for (const auto& record : records) seen.insert(record.moves);
    EXPECT_EQ(seen, (std::set<std::vector<std::string>>{{"E5", "C7"}, {"C3", "G7"}}));
    settings.openings.plies = 4;
    EXPECT_THROW(play(settings), engine::Error);
}

TEST(Match, ResumesWhatWasWritten) {
    const FakeEngine fake;
    auto settings = settings_for(fake.command(), fake.command("resign", "2"), 3);
    settings.out = fake.folder() / "match";
    EXPECT_EQ(play(settings).size(), 3u);
    // As if the machine had died in the middle of a line.
    engine::append_file(settings.out / "games.jsonl", R"({"game":3,"first":1,"na)");
    settings.games = 5;
    const auto rest = play(settings);
    ASSERT_EQ(rest.size(), 2u);
    EXPECT_EQ(rest[0].index, 3);
    EXPECT_EQ(rest[1].index, 4);
    EXPECT_TRUE(play(settings).empty());

    const auto games = go::sgf::parse(go::sgf::read_file(settings.out / "games.sgf"));
    ASSERT_EQ(games.size(), 5u);
    const auto last = go::sgf::main_line(games[4]);
    EXPECT_EQ(last.turns.size(), rest[1].moves.size());
    EXPECT_EQ(last.result, "B+R");
    EXPECT_EQ(games[4].nodes[0].value("PW"), "fake-resign");

    settings.go.komi = 6.5;
    try {
        play(settings);
        FAIL() << "other settings were taken";
    } catch (const engine::Error& error) {
        EXPECT_NE(std::string(error.what()).find("go/komi: 7.5 there, 6.5 here"), std::string::npos)
            << error.what();
    }
}

TEST(Match, StopsCleanlyInTheMiddle) {
    const FakeEngine fake;
    auto settings = settings_for(fake.command(), fake.command("hang", "3"), 2);
    std::stop_source stop;
    std::jthread soon([&] {
        std::this_thread::sleep_for(300ms);
        stop.request_stop();
    });
    const auto begin = Clock::now();
    EXPECT_TRUE(play(settings, stop.get_token()).empty());
    EXPECT_LT(Clock::now() - begin, 5s);
}

// What has no fraction would be no time at all.
TEST(Match, EnginesAreToldPartsOfASecondOrNoGameBegins) {
    const FakeEngine fake;
    const auto log = fake.folder() / "told";
    auto settings = settings_for(fake.command("exact", log.string()), fake.command(), 1);
    settings.rules.margin = 2s;
    settings.rules.time[0] = time_from_text("move 0.5");
    ASSERT_EQ(play(settings).size(), 1u);
    const auto told = engine::read_file(log);
    EXPECT_TRUE(told.starts_with("kata-time_settings byoyomi 0 0.5 1\n")) << told;
    EXPECT_NE(told.find("time_left b 0.5 1\n"), std::string::npos) << told;
    settings.rules.time[1] = time_from_text("move 0.5");
    EXPECT_THROW(play(settings), engine::Error);
}

TEST(Match, SprtStopsEarly) {
    const FakeEngine fake;
    auto settings = settings_for(fake.command(), fake.command("resign", "1"), 200);
    settings.sprt = Sprt{0, 200, 0.05, 0.05};
    settings.concurrency = 2;
    const auto records = play(settings);
    EXPECT_LT(records.size(), 60u);
    const Tally tally{static_cast<int>(records.size()), 0, 0};
    EXPECT_EQ(settings.sprt->verdict(tally), Sprt::Verdict::accept_elo1);
}

TEST(Match, ConcurrentGamesAreEachPlayedOnce) {
    const FakeEngine fake;
    auto settings = settings_for(fake.command(), fake.command(), 9);
    settings.concurrency = 3;
    std::set<int> seen;
    for (const auto& record : play(settings)) EXPECT_TRUE(seen.insert(record.index).second);
    EXPECT_EQ(seen.size(), 9u);
}

TEST(Match, RefusesWhatCannotWork) {
    const FakeEngine fake;
    EXPECT_THROW(play(settings_for("no-such-engine-anywhere", fake.command(), 1)), engine::Error);
    EXPECT_THROW(play(settings_for("false", fake.command(), 1)), engine::Error);
    EXPECT_THROW(play(settings_for("bash 'open", fake.command(), 1)), engine::Error);
    EXPECT_THROW(play(settings_for(fake.command(), fake.command(), 0)), engine::Error);
    auto settings = settings_for(fake.command(), fake.command(), 1);
    settings.sprt = Sprt{5, 0, 0.05, 0.05};
    EXPECT_THROW(play(settings), engine::Error);
}

TEST(Match, OurSearchPlaysItselfInProcess) {
    auto settings = settings_for("internal", "internal", 2);
    settings.go.size = 5;
    settings.agree_on_dead = false;
    for (auto& player : settings.players) {
        player.command = "internal memory=16 seed=3";
        player.protocol = "internal";
        player.visits = 60;
    }
    const auto records = play(settings);
    ASSERT_EQ(records.size(), 2u);
    for (const auto& record : records) {
        EXPECT_FALSE(record.by_fault()) << record.detail;
        EXPECT_GT(record.moves.size(), 5u);
    }
}

}  // namespace
}  // namespace selfplay
