// Perft: the number of leaves of a game's tree at some depth, the usual check of a move generator.
#pragma once

#include <cstdint>

#include "engine/game.h"

namespace engine {

// Counts every sequence of `depth` legal moves, over ends that only a claim makes. A game that
// counts faster has a `std::uint64_t perft(int depth) const` of its own.
template <Game G>
std::uint64_t perft(const G& game, int depth) {
    if constexpr (requires { game.perft(depth); }) {
        return game.perft(depth);
    } else {
        if (depth == 0) return 1;
        const auto moves = game.legal_moves();
        if (depth == 1) return static_cast<std::uint64_t>(moves.size());
        std::uint64_t nodes = 0;
        for (const Move move : moves) {
            G next = game;
            next.play(move);
            nodes += perft(next, depth - 1);
        }
        return nodes;
    }
}

}  // namespace engine
