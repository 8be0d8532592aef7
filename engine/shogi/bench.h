// How fast the rules of shogi are on one core: figures of `sanban bench rules`.
#pragma once

#include <vector>

#include "engine/base/figure.h"

namespace shogi {

// Perft nodes a second from the start (the last move of a line is counted, not played), and
// uniformly random rollouts from the start a second. Blocks for `seconds` a figure.
std::vector<engine::Figure> bench_rules(double seconds = 1);

}  // namespace shogi
