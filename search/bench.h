// What the search does and how fast: the figures of `sanban bench search`.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/figure.h"

namespace search {

// A number that changes whenever the search visits anything else than before: from fixed positions
// of every game, one thread, one seed, `simulations` each. The same on every x86-64.
std::uint32_t signature(std::uint64_t simulations = 3000);

// `signature`, the simulations a second of one thread from the empty Go boards, the same of every
// game under PUCT with an evaluator that costs nothing, by one thread and by two together, and the
// bytes of a node and an edge. The latter speeds go by processor time, so that what else runs
// counts little. Blocks for `seconds` a speed.
std::vector<engine::Figure> bench_search(double seconds = 1);

}  // namespace search
