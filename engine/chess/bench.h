// How fast the rules of chess are on one core: the figures of `sanban bench rules`.
#pragma once

#include <vector>

#include "engine/base/figure.h"

namespace chess {

// chess_perft (leaves a second, from the start and a middlegame), chess_rollouts (from the start)
// and chess_game_copy (with a past). Blocks for about `seconds` a figure.
std::vector<engine::Figure> bench_rules(double seconds = 1);

}  // namespace chess
