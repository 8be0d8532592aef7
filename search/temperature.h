// The choice of a move from visit counts with a temperature (AlphaGo Zero, Silver et al. 2017):
// in proportion to N^(1/temperature), which near 0 is the most visited move.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/base/random.h"

namespace search {

// Index drawn in proportion to count^(1/temperature); at temperature 0, or when all counts are 0,
// that of the greatest, the first of equals. `counts` must not be empty.
std::size_t draw_by_count(std::span<const std::uint64_t> counts, float temperature,
                          engine::Random& random);

}  // namespace search
