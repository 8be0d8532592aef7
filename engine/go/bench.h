// How fast the rules of Go are on one core: the figures of `sanban bench rules`.
#pragma once

#include <vector>

#include "engine/base/figure.h"

namespace go {

// Rollouts from the empty board a second, uniformly random and by policy; the nanoseconds that
// AlphaGo's rollout policy takes for a move, and that copying a state takes, history aside and with
// the history of a long game. Blocks for `seconds` a figure.
std::vector<engine::Figure> bench_rules(double seconds = 1);

}  // namespace go
