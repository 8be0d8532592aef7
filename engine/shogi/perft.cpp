#include "engine/shogi/perft.h"

#include "engine/shogi/movegen.h"

namespace shogi {
namespace {

// The last move of every line is counted, not played.
template <Player us>
std::uint64_t count_lines(const Position& position, int depth) {
    if (depth == 1) return static_cast<std::uint64_t>(count_legal_moves_as<us>(position));
    std::uint64_t lines = 0;
    for (const Move move : legal_moves_as<us>(position)) {
        Position next = position;
        next.play_as<us>(move);
        lines += count_lines<~us>(next, depth - 1);
    }
    return lines;
}

}  // namespace

std::uint64_t perft(const Position& position, int depth) {
    if (depth <= 0) return 1;
    return position.to_play() == Player::first ? count_lines<Player::first>(position, depth)
                                               : count_lines<Player::second>(position, depth);
}

}  // namespace shogi
