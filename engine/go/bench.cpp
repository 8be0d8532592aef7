#include "engine/go/bench.h"

#include <fmt/format.h>

#include "engine/base/measure.h"
#include "engine/base/random.h"
#include "engine/go/rollouts.h"

namespace go {

namespace {

template <class Kind>
engine::Figure rollouts(int size, double seconds, std::string_view name = "rollouts") {
    const Go game(size);
    engine::Random random(1);
    Kind rollouts;
    const double rate = engine::calls_per_second(seconds, [&] { rollouts.play(game, random); });
    return {fmt::format("go{}_{}", size, name), rate, "rollouts/s"};
}

// Copies to and fro between two values, as the search does from node to node.
template <class T>
double copy_time(double seconds, const T& value) {
    std::vector<T> values(2, value);
    // Volatile, or the compiler would see that the copies change nothing.
    volatile std::size_t from = 0;
    const double rate = engine::calls_per_second(
        seconds,
        [&] {
            values[1 - from] = values[from];
            from = 1 - from;
        },
        10000);
    return 1e9 / rate;
}

Go random_game(int size, int moves) {
    Go game(size);
    engine::Random random(1);
    for (int i = 0; i < moves; ++i) {
        auto legal = game.legal_moves();
        legal.filter([&](Move move) { return !game.fills_own_eye(move) && move != Go::pass; });
        game.play(legal.empty() ? Go::pass : legal[random.below(legal.size())]);
    }
    return game;
}

}  // namespace

std::vector<engine::Figure> bench_rules(double seconds) {
    const Go game = random_game(19, 200);
    constexpr std::string_view by_policy = "policy_rollouts";
    return {rollouts<RandomRollouts>(9, seconds),
            rollouts<RandomRollouts>(13, seconds),
            rollouts<RandomRollouts>(19, seconds),
            rollouts<Rollouts>(9, seconds, by_policy),
            rollouts<Rollouts>(19, seconds, by_policy),
            {"go19_board_copy", copy_time(seconds, game.board()), "ns"},
            {"go19_game_copy", copy_time(seconds, game), "ns"}};
}

}  // namespace go
