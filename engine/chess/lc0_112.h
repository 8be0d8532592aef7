// Chess as lc0's networks with classical input see it (FORMATS.md 2.4): 8 boards of 13 planes from
// the mover's side and 8 planes of castling, colour, halfmove clock and ones; the policy is lc0's
// list of 1858 moves. Boards before the first known one repeat it, or stay empty where the game
// began at the usual start, as is lc0's default.
#pragma once

#include "engine/chess/chess.h"
#include "engine/encoding.h"

namespace chess {

engine::Encoding<Chess> lc0_112();

}  // namespace chess
