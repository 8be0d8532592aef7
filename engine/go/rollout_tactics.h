// What moves do to chains, read from a tactical RolloutBoard: for the policies that play rollouts.
#pragma once

#include "engine/go/liberty_sums.h"
#include "engine/go/rollout_board.h"

namespace go {

// How many liberties the mover's chain would have: 0 (suicide, and no move), 1, or 2 for more.
template <Colour colour, class Board>
int liberties_after(const Board& board, int at) {
    if (board.empty_neighbours(at) >= 2) return 2;
    int known = 0;
    const auto another = [&](int liberty) {
        const bool differs = known != 0 && known != liberty;
        known = liberty;
        return differs;
    };
    const auto beside_it = Board::neighbours(at);
    for (const int beside : beside_it) {
        const auto there = board.at(beside);
        if (there == Colour::edge) continue;
        if (there == Colour::empty) {
            if (another(beside)) return 2;
            continue;
        }
        auto left = board.liberties(beside);
        for (const int side : beside_it)
            if (board.head(side) == board.head(beside)) left -= LibertySum(at);
        if (there == colour) {
            if (left.none()) continue;
            if (!left.only_one() || another(left.the_one())) return 2;
        } else if (left.none()) {
            // Stones taken beside one's own chain leave liberties there as well.
            if (another(beside) || board.chain_size(beside) > 1) return 2;
        }
    }
    return known != 0 ? 1 : 0;
}

// Calls action(move, captures) for the ways to save the mover's chain in atari: its extension,
// where that leaves it more than one liberty, and what can be captured beside it.
template <Colour colour, class Board, class Action>
void for_each_rescue(const Board& board, int chain, Action action) {
    const int out = board.last_liberty(chain);
    if (liberties_after<colour>(board, out) > 1) action(out, false);
    int stone = chain;
    do {
        for (const int beside : Board::neighbours(stone)) {
            if (board.at(beside) != opponent(colour) || !board.in_atari(beside)) continue;
            const int at = board.last_liberty(beside);
            if (at != out && board.template is_legal<colour>(at)) action(at, true);
        }
        stone = board.next(stone);
    } while (stone != chain);
}

}  // namespace go
