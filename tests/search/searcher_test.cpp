#include "search/searcher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "tests/search/tictactoe.h"

using tictactoe::TicTacToe;
using namespace std::chrono_literals;

namespace search {
namespace {

SearchParams small() {
    SearchParams params;
    params.memory_mib = 16;
    return params;
}

Limits simulations(std::uint64_t count) {
    Limits limits;
    limits.simulations = count;
    return limits;
}

// Plays `moves` (cells 1-9) from the start, then searches with random rollouts.
std::string best_after(std::string_view moves, std::uint64_t count) {
    Searcher<TicTacToe> searcher(small());
    const auto game = TicTacToe::from_text(moves);
    searcher.set_position(game);
    return game.move_to_text(searcher.think(simulations(count)).moves.at(0).move);
}

TEST(Searcher, TakesAWinInOne) { EXPECT_EQ(best_after("1425", 500), "3"); }
TEST(Searcher, BlocksALossInOne) { EXPECT_EQ(best_after("152", 500), "3"); }
TEST(Searcher, AnswersACornerInTheCentre) { EXPECT_EQ(best_after("1", 3000), "5"); }

TEST(Searcher, RunsExactlyTheSimulationsAskedFor) {
    auto params = small();
    params.early_end = false;
    params.threads = 2;
    Searcher<TicTacToe> searcher(params);
    const auto picture = searcher.think(simulations(5000));
    EXPECT_EQ(picture.simulations, 5000u);
    EXPECT_EQ(picture.visits, 5000u);
}

TEST(Searcher, StopsWhenAskedAndSaysSoOnce) {
    Searcher<TicTacToe> searcher(small());
    int ended = 0;
    searcher.start({}, {}, [&](const Analysis&) { ++ended; });
    std::this_thread::sleep_for(20ms);
    EXPECT_TRUE(searcher.thinking());
    searcher.stop();
    EXPECT_FALSE(searcher.thinking());
    EXPECT_EQ(ended, 1);
    EXPECT_GT(searcher.analysis().visits, 0u);
}

TEST(Searcher, KnowsTheMovesHoweverSoonItIsStopped) {
    Searcher<TicTacToe> searcher(small());
    for (int i = 0; i < 100; ++i) {
        searcher.clear();
        searcher.start({}, {}, {});
        searcher.stop();
        ASSERT_EQ(searcher.analysis().moves.size(), 9u);
    }
}

Analysis analysed(SearchParams params, std::uint64_t count) {
    params.early_end = false;
    Searcher<TicTacToe> searcher(params);
    return searcher.think(simulations(count));
}

std::vector<std::uint64_t> visits(const Analysis& picture) {
    std::vector<std::uint64_t> counts;
    for (const auto& move : picture.moves) {
        counts.push_back(move.move.code);
        counts.insert(counts.end(), move.variation_visits.begin(), move.variation_visits.end());
    }
    return counts;
}

TEST(Searcher, OneThreadAndOneSeedGiveOneTree) {
    EXPECT_EQ(visits(analysed(small(), 3000)), visits(analysed(small(), 3000)));
    auto other = small();
    other.seed = 2;
    EXPECT_NE(visits(analysed(small(), 3000)), visits(analysed(other, 3000)));
}

TEST(Searcher, ClearingStartsAsNew) {
    auto params = small();
    params.early_end = false;
    Searcher<TicTacToe> searcher(params);
    const auto first = searcher.think(simulations(2000));
    searcher.clear();
    EXPECT_EQ(visits(first), visits(searcher.think(simulations(2000))));
}

TEST(Searcher, ManyThreadsLoseNoVisit) {
    auto params = small();
    params.threads = 4;
    params.early_end = false;
    Searcher<TicTacToe> searcher(params);
    // Any number of threads may judge a root that has no children yet: one visit gives it some.
    ASSERT_EQ(searcher.think(simulations(1)).visits, 1u);
    const auto picture = searcher.think(simulations(20000));
    EXPECT_EQ(picture.simulations, 20000u);
    EXPECT_EQ(picture.visits, 20001u);
    std::uint64_t sum = 0;
    for (const auto& move : picture.moves) sum += move.visits;
    EXPECT_EQ(sum, 20000u);
    EXPECT_GE(picture.deepest, 5);
    EXPECT_LE(picture.deepest, 9);
    EXPECT_GE(picture.depth, 2);
}

TEST(Searcher, AnalysisIsOrderedAndWithinBounds) {
    const auto picture = analysed(small(), 5000);
    ASSERT_EQ(picture.moves.size(), 9u);
    for (std::size_t i = 1; i < picture.moves.size(); ++i)
        EXPECT_GE(picture.moves[i - 1].visits, picture.moves[i].visits);
    for (const auto& move : picture.moves) {
        EXPECT_LE(move.lcb, move.value);
        EXPECT_GE(move.lcb, -1.0f);
        EXPECT_NEAR(move.prior, 1.0f / 9, 1e-4);
        ASSERT_FALSE(move.variation.empty());
        EXPECT_EQ(move.variation[0], move.move);
        EXPECT_EQ(move.variation.size(), move.variation_visits.size());
    }
}

TEST(Searcher, ReadersSeeAPictureWhileItThinks) {
    auto params = small();
    params.threads = 2;
    Searcher<TicTacToe> searcher(params);
    searcher.start({}, {}, {});
    std::uint64_t last = 0;
    for (int i = 0; i < 50; ++i) {
        const auto picture = searcher.analysis(3);
        EXPECT_GE(picture.visits, last);
        EXPECT_LE(picture.moves.size(), 3u);
        last = picture.visits;
        std::this_thread::sleep_for(1ms);
    }
    searcher.stop();
    EXPECT_GE(searcher.analysis().visits, last);
}

TEST(Searcher, TreatsRootMovesAsTold) {
    Searcher<TicTacToe> searcher(small());
    auto limits = simulations(500);
    limits.only = {Move{0}, Move{4}};
    EXPECT_EQ(searcher.think(limits).moves.size(), 2u);
    limits.only = {};
    limits.avoid = {Move{4}};
    const auto picture = searcher.think(limits);
    EXPECT_EQ(picture.moves.size(), 8u);
    for (const auto& move : picture.moves) EXPECT_NE(move.move.code, 4);
}

TEST(Searcher, KeepsTheTreeAfterBothSidesMoves) {
    Searcher<TicTacToe> searcher(small());
    const auto first = searcher.think(simulations(3000)).moves.at(0);
    searcher.advance(first.move);
    EXPECT_EQ(searcher.analysis().visits, first.visits);
    const auto reply = searcher.analysis().moves.at(0);
    searcher.advance(reply.move);
    EXPECT_EQ(searcher.analysis().visits, reply.visits);
    EXPECT_GT(reply.visits, 50u);
}

TEST(Searcher, FindsThePositionTwoMovesOn) {
    Searcher<TicTacToe> searcher(small());
    const auto best = searcher.think(simulations(3000)).moves.at(0);
    auto game = searcher.position();
    game.play(best.variation.at(0));
    game.play(best.variation.at(1));
    searcher.set_position(game);
    EXPECT_EQ(searcher.analysis().visits, best.variation_visits.at(1));
    searcher.set_position(TicTacToe{});
    EXPECT_EQ(searcher.analysis().visits, 0u);
}

TEST(Searcher, PonderingTakesItsLimitsFromTheHit) {
    Searcher<TicTacToe> searcher(small());
    auto limits = simulations(10);
    limits.ponder = true;
    std::atomic<bool> ended = false;
    searcher.start(limits, {}, [&](const Analysis&) { ended = true; });
    std::this_thread::sleep_for(20ms);
    EXPECT_FALSE(ended);
    EXPECT_GT(searcher.analysis().simulations, 10u);
    searcher.ponder_hit();
    for (int i = 0; i < 1000 && !ended; ++i) std::this_thread::sleep_for(1ms);
    EXPECT_TRUE(ended);
}

TEST(Searcher, AFixedTimeIsKept) {
    Searcher<TicTacToe> searcher(small());
    Limits limits;
    limits.time = 60ms;
    const auto picture = searcher.think(limits);
    EXPECT_GE(picture.elapsed, 60ms);
    EXPECT_LT(picture.elapsed, 160ms);
}

TEST(Searcher, TheClockEndsAThinkInTime) {
    auto params = small();
    params.lag_ms = 150;
    Searcher<TicTacToe> searcher(params);
    Limits limits;
    TimeControl control;
    control.unlimited = false;
    control.period = 250ms;
    control.periods = 1;
    limits.clock = TimeLeft::start_of(control);
    EXPECT_LT(searcher.think(limits).elapsed, 250ms);
}

TEST(Searcher, AFinishedGameEndsABoundedThinkAtOnce) {
    Searcher<TicTacToe> searcher(small());
    searcher.set_position(TicTacToe::from_text("14253"));
    Limits limits;
    limits.time = 10s;
    const auto picture = searcher.think(limits);
    EXPECT_LT(picture.elapsed, 5s);
    EXPECT_TRUE(picture.moves.empty());
    EXPECT_EQ(picture.value, -1.0f);
}

TEST(Searcher, AFinishedGameLeavesAnEndlessThinkWaiting) {
    Searcher<TicTacToe> searcher(small());
    searcher.set_position(TicTacToe::from_text("14253"));
    searcher.start({}, {}, {});
    std::this_thread::sleep_for(20ms);
    EXPECT_TRUE(searcher.thinking());
    searcher.stop();
}

TEST(Searcher, ReportsComeWhileItThinks) {
    Searcher<TicTacToe> searcher(small());
    Limits limits;
    limits.time = 100ms;
    limits.report_every = 10ms;
    std::atomic<int> reports = 0;
    searcher.start(limits,
                   [&](const Analysis& picture) { reports += picture.moves.empty() ? 0 : 1; }, {});
    while (searcher.thinking()) std::this_thread::sleep_for(1ms);
    EXPECT_GE(reports, 3);
    EXPECT_LE(reports, 10);
}

TEST(Searcher, StopsWithinMilliseconds) {
    auto params = small();
    params.threads = 2;
    Searcher<TicTacToe> searcher(params);
    std::vector<double> waits;
    for (int i = 0; i < 21; ++i) {
        searcher.start({}, {}, {});
        std::this_thread::sleep_for(3ms);
        const auto asked = std::chrono::steady_clock::now();
        searcher.stop();
        const std::chrono::duration<double, std::milli> wait =
            std::chrono::steady_clock::now() - asked;
        waits.push_back(wait.count());
    }
    std::nth_element(waits.begin(), waits.begin() + 10, waits.end());
    EXPECT_LT(waits[10], 20.0);  // the median, and generous: the machine may be busy
}

TEST(Searcher, AForcedMoveTakesNoTime) {
    Searcher<TicTacToe> searcher(small());
    searcher.set_position(TicTacToe::from_text("12345687"));
    Limits limits;
    TimeControl control;
    control.unlimited = false;
    control.main = 60s;
    limits.clock = TimeLeft::start_of(control);
    const auto picture = searcher.think(limits);
    ASSERT_EQ(picture.moves.size(), 1u);
    EXPECT_LT(picture.elapsed, 1s);
}

TEST(Searcher, EndsEarlyWhenTheLeaderCannotBeCaught) {
    Searcher<TicTacToe> searcher(small());
    searcher.set_position(TicTacToe::from_text("1425"));
    const auto picture = searcher.think(simulations(100000));
    EXPECT_LT(picture.simulations, 80000u);
    EXPECT_EQ(picture.moves.at(0).move.code, 2);
}

// A game whose rollouts fail, as a broken evaluator would.
struct Broken : TicTacToe {
    static Broken from_text(std::string_view) { return {}; }
    struct Rollouts {
        engine::RolloutResult play(const Broken&, engine::Random& random) {
            if (random.below(50) == 0) engine::fail("the evaluator is broken");
            return {};
        }
    };
};

TEST(Searcher, AFaultEndsTheThinkWithItsMessage) {
    auto params = small();
    params.threads = 2;
    Searcher<Broken> searcher(params);
    const auto picture = searcher.think({});
    EXPECT_EQ(picture.fault, "the evaluator is broken");
    EXPECT_FALSE(picture.moves.empty());
    searcher.set_position(Broken{});
    EXPECT_FALSE(searcher.think({}).fault.empty());
}

TEST(Searcher, NewParametersTakeEffect) {
    Searcher<TicTacToe> searcher(small());
    searcher.set_position(TicTacToe::from_text("15"));
    searcher.think(simulations(100));
    auto params = small();
    params.threads = 3;
    searcher.set_params(params);
    EXPECT_EQ(searcher.analysis().visits, 100u);
    params.memory_mib = 17;
    searcher.set_params(params);
    EXPECT_EQ(searcher.analysis().visits, 0u);
    EXPECT_EQ(searcher.position(), TicTacToe::from_text("15"));
    EXPECT_EQ(searcher.think(simulations(100)).moves.size(), 7u);
}

}  // namespace
}  // namespace search
