// How many lines of legal moves a position has, `depth` moves long: the check on the rules and the
// measure of their speed. Repetition does not end a line, drop-pawn mate is no move.
#pragma once

#include <cstdint>

#include "engine/shogi/position.h"

namespace shogi {

// 1 at depth 0.
std::uint64_t perft(const Position& position, int depth);

}  // namespace shogi
