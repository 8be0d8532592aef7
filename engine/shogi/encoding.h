// How networks see shogi: AlphaZero's 362 planes of 9x9 and its 9x9x139 moves (Silver et al. 2018,
// table S2), the board turned so that the mover plays up.
//
// Planes, for the position and each of the 7 before it (zeros before the first): own pieces 14,
// the opponent's 14 (in the order of board_kinds), repetitions 3 (plane i is 1 where the position
// had occurred more than i times before), own hand 7, the opponent's hand 7 (in the order of
// hand_kinds, as shares of a full set). Then the colour (1 where White moves) and the number of
// moves played, in units of 512. Rows are ranks from the far side, columns go from the left.
// Policy: plane * 81 + square, planes being 8 directions x 1..8 steps and 2 knight jumps from the
// square moved from, the same 66 with promotion, and 7 drops on the square moved to.
#pragma once

#include <span>

#include "engine/encoding.h"
#include "engine/shogi/shogi.h"

namespace shogi::alphazero {

inline constexpr int boards = 8, planes_per_board = 45, planes = boards * planes_per_board + 2;
inline constexpr int move_planes = 139, policy_size = move_planes * square_count;

void write(const Shogi& game, std::span<float> planes, std::span<float> globals);
int policy_index(const Shogi& game, Move move);

}  // namespace shogi::alphazero
