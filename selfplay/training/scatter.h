// First positions that show at once what men are worth and how a king is mated, which games from
// the usual one do not as long as neither side can win what it has won. From any thread.
#pragma once

#include "engine/base/random.h"
#include "engine/chess/chess.h"

namespace selfplay::training {

// Some of the men of either side, about as many of each, on squares at random; either to move.
// Legal, without castling, and not over.
chess::Chess scattered_chess(engine::Random& random);

}  // namespace selfplay::training
