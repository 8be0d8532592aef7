#include "search/bench.h"

#include <chrono>

#include "engine/games.h"
#include "search/searcher.h"

namespace search {

namespace {

SearchParams one_thread() {
    SearchParams params;
    params.memory_mib = 64;
    params.early_end = false;
    return params;
}

// FNV-1a, 32 bits.
void mix(std::uint32_t& hash, std::uint64_t number) {
    for (int byte = 0; byte < 8; ++byte) {
        hash ^= static_cast<std::uint8_t>(number >> 8 * byte);
        hash *= 16777619u;
    }
}

// From the start and after 30 random moves, the tree kept for one more think.
template <engine::Game G>
void mix_game(std::uint32_t& hash, const G& start, std::uint64_t simulations) {
    Searcher<G> searcher(one_thread());
    engine::Random random(1);
    Limits limits;
    limits.simulations = simulations;
    G game = start;
    for (int moves = 0; moves <= 31 && game.outcome() == engine::Outcome::ongoing; ++moves) {
        if (moves == 0 || moves >= 30) {
            searcher.set_position(game);
            const auto picture = searcher.think(limits);
            mix(hash, picture.visits);
            for (const auto& move : picture.moves) mix(hash, move.visits << 16 | move.move.code);
            game.play(picture.moves.at(0).move);
        } else {
            const auto legal = game.legal_moves();
            game.play(legal[random.below(legal.size())]);
        }
    }
}

double simulations_per_second(const go::Go& game, double seconds) {
    Searcher<go::Go> searcher(one_thread());
    searcher.set_position(game);
    Limits limits;
    limits.time = Milliseconds(static_cast<std::int64_t>(seconds * 1000));
    const auto picture = searcher.think(limits);
    const std::chrono::duration<double> took = picture.elapsed;
    return static_cast<double>(picture.simulations) / took.count();
}

}  // namespace

std::uint32_t signature(std::uint64_t simulations) {
    std::uint32_t hash = 2166136261u;
    mix_game(hash, go::Go(9), simulations);
    mix_game(hash, go::Go(19), simulations / 4);
    mix_game(hash, chess::Chess{}, simulations / 10);
    mix_game(hash, shogi::Shogi{}, simulations / 10);
    return hash;
}

std::vector<engine::Figure> bench_search(double seconds) {
    return {
        {"signature", static_cast<double>(signature()), "hash"},
        {"go9_uct_sims", simulations_per_second(go::Go(9), seconds), "simulations/s"},
        {"go19_uct_sims", simulations_per_second(go::Go(19), seconds), "simulations/s"},
        {"node_bytes", static_cast<double>(sizeof(Node)), "bytes"},
        {"edge_bytes", static_cast<double>(sizeof(Edge)), "bytes"},
    };
}

}  // namespace search
