// Channels, nodes and points are counted in `int`; containers are indexed by `size_t`.
#pragma once

#include <concepts>
#include <cstddef>

namespace nn {

// `index`, not negative, as containers take it.
template <std::signed_integral Index>
constexpr std::size_t at(Index index) {
    return static_cast<std::size_t>(index);
}

}  // namespace nn
