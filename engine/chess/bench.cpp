#include "engine/chess/bench.h"

#include "engine/base/measure.h"
#include "engine/base/random.h"
#include "engine/chess/chess.h"
#include "engine/chess/rollouts.h"

namespace chess {

namespace {

constexpr auto middlegame = "r3k2r/p1ppqpb1/bn2pnp1/3PN3/1p2P3/2N2Q1p/PPPBBPPP/R3K2R w KQkq - 0 1";

engine::Figure perft_figure(double seconds) {
    const Chess start, middle = Chess::from_text(middlegame);
    std::uint64_t nodes = 0;
    const double rate = engine::calls_per_second(
        seconds, [&] { nodes = start.perft(5) + middle.perft(4); }, 1);
    return {"chess_perft", rate * static_cast<double>(nodes), "nodes/s"};
}

engine::Figure rollouts_figure(double seconds) {
    const Chess start;
    engine::Random random(1);
    const Rollouts rollouts;
    const double rate = engine::calls_per_second(
        seconds, [&] { rollouts.play(start, random); }, 16);
    return {"chess_rollouts", rate, "rollouts/s"};
}

Chess random_game(int plies) {
    Chess game;
    engine::Random random(1);
    for (int ply = 0; ply < plies && game.outcome() == Outcome::ongoing; ++ply) {
        const auto legal = game.legal_moves();
        game.play(legal[random.below(legal.size())]);
    }
    return game;
}

engine::Figure copy_figure(double seconds) {
    std::vector<Chess> games(2, random_game(60));
    // Volatile, or the compiler would see that the copies change nothing.
    volatile std::size_t from = 0;
    const double rate = engine::calls_per_second(
        seconds,
        [&] {
            games[1 - from] = games[from];
            from = 1 - from;
        },
        10000);
    return {"chess_game_copy", 1e9 / rate, "ns"};
}

}  // namespace

std::vector<engine::Figure> bench_rules(double seconds) {
    return {perft_figure(seconds), rollouts_figure(seconds), copy_figure(seconds)};
}

}  // namespace chess
