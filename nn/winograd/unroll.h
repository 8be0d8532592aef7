// Loops unrolled by the compiler for certain, so that arrays of vectors live in registers. For the
// kernels; no standard library code.
#pragma once

namespace nn::winograd {

template <int value>
struct Index {
    [[gnu::always_inline]] constexpr operator int() const { return value; }
};

// body(Index<0>{}) … body(Index<count - 1>{})
template <int count, class Body>
[[gnu::always_inline]] inline void repeat(const Body& body) {
    if constexpr (count > 0) {
        repeat<count - 1>(body);
        body(Index<count - 1>{});
    }
}

}  // namespace nn::winograd
