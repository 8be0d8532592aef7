// What a node's counts need of the memory model: numbers that many threads add to and that order
// nothing else.
#pragma once

#include <atomic>

namespace search {

inline constexpr auto relaxed = std::memory_order_relaxed;

}  // namespace search
