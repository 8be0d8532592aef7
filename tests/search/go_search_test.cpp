#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <memory>
#include <string>
#include <thread>

#include "engine/go/go.h"
#include "engine/go/rollouts.h"
#include "search/searcher.h"

namespace search {
namespace {

using go::Go;

SearchParams small(int threads) {
    SearchParams params;
    params.memory_mib = 16;
    params.threads = threads;
    params.early_end = false;
    return params;
}

// MiB of this process in memory, 0 where the system does not say.
double resident_mib() {
    std::ifstream statm("/proc/self/statm");
    double total = 0, resident = 0;
    statm >> total >> resident;
    return resident * 4096 / (1 << 20);
}

TEST(GoSearch, KnowsWhoOwnsWhat) {
    Searcher<Go> searcher(small(1));
    Go game(5);
    for (const auto* move : {"C1", "E5", "C2", "E4", "C3", "E3", "C4", "pass", "C5", "pass"})
        game.play(*game.move_from_text(move));
    searcher.set_position(game);
    Limits limits;
    limits.simulations = 2000;
    const auto picture = searcher.think(limits);
    ASSERT_EQ(picture.owners.size(), 25u);
    EXPECT_GT(picture.owners[2 * 5 + 2], 0.9f);  // C3, the mover's own
    EXPECT_GT(picture.owners[2 * 5 + 0], 0.5f);  // A3, behind it
    EXPECT_GT(picture.lead, -7.5f);
}

// Plays a game of 200 simulations a move on 7x7 with a komi that favours neither.
engine::Outcome duel(float black_rave, float white_rave, int seed) {
    const auto player = [&](float rave) {
        auto params = small(1);
        params.rave = rave;
        params.seed = seed;
        return std::make_unique<Searcher<Go>>(params);
    };
    const std::array players = {player(black_rave), player(white_rave)};
    Go game(7, go::Komi::from_points(8.5));
    for (const auto& searcher : players) searcher->set_position(game);
    Limits limits;
    limits.simulations = 200;
    while (game.outcome() == engine::Outcome::ongoing && game.move_count() < 150) {
        const auto mover = game.to_play() == engine::Player::first ? 0u : 1u;
        const auto move = players[mover]->think(limits).moves.at(0).move;
        game.play(move);
        for (const auto& searcher : players) searcher->advance(move);
    }
    return game.outcome();
}

TEST(GoSearch, RaveBeatsPlainUctAtTheSameSimulations) {
    int wins = 0;
    for (int seed = 1; seed <= 4; ++seed) {
        wins += duel(1000, 0, seed) == engine::Outcome::first_wins ? 1 : 0;
        wins += duel(0, 1000, seed) == engine::Outcome::second_wins ? 1 : 0;
    }
    EXPECT_GE(wins, 7);
}

// A budget of which the tree needs many times as much: search goes on, within it.
TEST(GoSearch, GoesOnInALittleMemory) {
    const double before = resident_mib();
    auto params = small(2);
    Searcher<Go> searcher(params);
    searcher.set_position(Go(9));
    Limits limits;
    limits.simulations = 50000;
    std::uint64_t visits = 0;
    for (int part = 0; part < 2; ++part) {
        const auto picture = searcher.think(limits);
        EXPECT_EQ(picture.simulations, 50000u);
        EXPECT_EQ(picture.visits, visits + 50000u);
        EXPECT_TRUE(picture.fault.empty());
        EXPECT_LE(picture.memory_used, 1.0f);
        visits = picture.visits;
    }
// The thread sanitizer's own memory is resident too, and grows with the work it watches.
#if !defined(__SANITIZE_THREAD__)
    EXPECT_LT(resident_mib() - before, 16 + 32);
#else
    static_cast<void>(before);
#endif
    const auto best = searcher.position().point_of(searcher.analysis().moves.at(0).move);
    ASSERT_TRUE(best);  // no pass on the empty board, and no move on the first line
    EXPECT_TRUE(best->x > 0 && best->x < 8 && best->y > 0 && best->y < 8);
}

TEST(GoSearch, StopsInTheMiddleOfLongRollouts) {
    Searcher<Go> searcher(small(2));
    searcher.set_position(Go(25));
    searcher.start({}, {}, {});
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    searcher.stop();
    EXPECT_FALSE(searcher.thinking());
    EXPECT_EQ(searcher.analysis().moves.size(), 626u);
}

// Games of Go end slowly: as many moves as points and a quarter more, each later than planned by
// all that is kept back, must find time on the clock.
TEST(GoSearch, PlansItsClockForTheWholeGame) {
    for (const int size : {9, 13, 19}) {
        TimeControl control;
        control.unlimited = false;
        control.main = Milliseconds(30000);
        auto left = TimeLeft::start_of(control);
        Go game(size);
        const Milliseconds lag(20);
        Milliseconds in_the_opening(0);
        for (int move = 0; move < size * size * 5 / 4; ++move) {
            const auto time = allot(left, moves_to_come(game), lag);
            if (move == 0) in_the_opening = time->soft;
            if (move % 2 == 0) {
                ASSERT_TRUE(left.spend(time->soft + lag)) << size << ' ' << move;
            }
            game.play(Go::pass);
        }
        EXPECT_GT(in_the_opening, Milliseconds(100));
    }
}

}  // namespace
}  // namespace search
