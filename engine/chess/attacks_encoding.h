// Chess for networks that are too small to find out by themselves who attacks what: the present
// board and its attacks, nothing of the past; reached through Chess::encodings() as "attacks".
//
// All is seen from the mover's side, as in chess/encoding.h, and the policy is the same as there.
// Planes of 8x8: the mover's pawns, knights, bishops, rooks, queens, king and the opponent's (12);
// the squares that each of these attacks, x-rays left out (12); squares that the mover attacks
// twice or more, the opponent likewise; the square of a capture en passant. Then full planes: the
// mover's castling to the king's and to the queen's side, the opponent's; the halfmove clock / 100;
// 1 where the position has occurred before; 1.
#pragma once

#include "engine/chess/chess.h"
#include "engine/encoding.h"

namespace chess {

engine::Encoding<Chess> attacks_encoding();

}  // namespace chess
