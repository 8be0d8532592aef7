// Shogi for networks that are too small to find out by themselves who attacks what: the present
// board and its attacks, nothing of the past; reached through Shogi::encodings() as "attacks".
//
// The board is turned so that the mover plays up, as in shogi/encoding.h, and the policy is the
// same as there. Planes of 9x9: own pieces 14, the opponent's 14 (in the order of board_kinds);
// squares that the mover attacks at least once, twice, three times, the opponent likewise. Then
// full planes: own hand 7, the opponent's 7 (in the order of hand_kinds, as shares of a full set);
// 1 where the position has occurred before; 1.
#pragma once

#include "engine/encoding.h"
#include "engine/shogi/shogi.h"

namespace shogi {

engine::Encoding<Shogi> attacks_encoding();

}  // namespace shogi
