#include "search/searcher.h"

#include <gtest/gtest.h>

#include <thread>

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
    EXPECT_GT(searcher.analysis().visits, 100u);
}

}  // namespace
}  // namespace search
