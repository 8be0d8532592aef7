// Chess as networks see it, by AlphaZero's scheme (Silver et al. 2018, tables S1 and S2); reached
// through Chess::encodings().
//
// All is seen from the mover's side: row 0 is the mover's own back rank, and for Black the board is
// turned by ranks, files staying where they are. Planes: for the present and the 7 boards before it
// the mover's pawns, knights, bishops, rooks, queens, king, the opponent's, and two that are full
// when the board had occurred once and twice before; boards before the first are empty. Then full
// planes: 1 when Black moves; the move number / 100; the mover's castling to the king's and to the
// queen's side, the opponent's; the halfmove clock / 100.
#pragma once

#include <span>

#include "engine/chess/chess.h"

namespace chess::alphazero {

inline constexpr int boards = 8, planes_per_board = 14, planes = boards * planes_per_board + 7;
inline constexpr int move_planes = 73, policy_size = move_planes * 64;

void write(const Chess& game, std::span<float> planes, std::span<float> globals);

// move plane * 64 + row * 8 + file of the origin. Move planes: 8 directions (from north clockwise)
// by 7 distances, 8 knight's leaps (clockwise from north-north-east), and promotions to knight,
// bishop, rook by capture to the left, straight on, and by capture to the right. Promotions to a
// queen are plain moves. Castling is the king going to its rook's square, in Chess960 or not.
int policy_index(const Chess& game, Move move);

}  // namespace chess::alphazero
