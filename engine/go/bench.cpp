#include "engine/go/bench.h"

#include <fmt/format.h>

#include "engine/base/measure.h"
#include "engine/base/random.h"
#include "engine/go/linear_policy.h"
#include "engine/go/rollouts.h"
#include "engine/go/softmax_policy.h"

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

// Nanoseconds that AlphaGo's rollout policy takes for a move, drawn and played, in rollouts from
// the empty board. Its speed does not depend on what it prefers: these logits are drawn.
template <int size>
engine::Figure linear_moves(double seconds) {
    engine::Random random(1);
    std::vector<float> logits(static_cast<std::size_t>(features::count));
    for (auto& logit : logits) logit = static_cast<float>(2 * uniform(random) - 1);
    const Factors factors(logits);
    const Go game(size);
    double moves = 0;
    const double start = engine::processor_seconds();
    while (engine::processor_seconds() < start + seconds) {
        SoftmaxPolicy<size> rollout(factors, game);
        for (int passes = 0, ply = 0; passes < 2 && ply < 3 * size * size; ++ply, ++moves)
            passes = (ply % 2 == 0 ? rollout.template play<Colour::black>(random)
                                   : rollout.template play<Colour::white>(random)) != 0
                         ? 0
                         : passes + 1;
    }
    return {fmt::format("go{}_linear_policy", size),
            1e9 * (engine::processor_seconds() - start) / moves, "ns/move"};
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
            linear_moves<9>(seconds),
            linear_moves<19>(seconds),
            {"go19_board_copy", copy_time(seconds, game.board()), "ns"},
            {"go19_game_copy", copy_time(seconds, game), "ns"}};
}

}  // namespace go
