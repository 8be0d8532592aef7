// What a 16-bit move code means in shogi: bits 0-6 the square moved to, bits 7-13 the square
// moved from or, from 81 on, the kind dropped, bit 14 promotion. Code 0 is no move.
#pragma once

#include "engine/game.h"
#include "engine/shogi/bitboard.h"
#include "engine/shogi/piece.h"

namespace shogi {

using engine::Move;

constexpr Move board_move(int from, int to, bool promotes = false) {
    return {static_cast<std::uint16_t>(to | from << 7 | (promotes ? 1 << 14 : 0))};
}
constexpr Move drop_move(Kind kind, int to) {
    return board_move(square_count - 1 + static_cast<int>(kind), to);
}

constexpr int to_square(Move move) { return move.code & 127; }
// The square left, or something from 81 on for a drop.
constexpr int from_square(Move move) { return move.code >> 7 & 127; }
constexpr bool is_drop(Move move) { return from_square(move) >= square_count; }
constexpr bool is_promotion(Move move) { return (move.code >> 14 & 1) != 0; }
// Only of a drop.
constexpr Kind dropped_kind(Move move) {
    return static_cast<Kind>(from_square(move) - square_count + 1);
}

}  // namespace shogi
