// The encodings of Go that show stones and nothing else, now and 7 moves back: AlphaGo Zero's 17
// planes (Silver et al. 2017), and the 18 of Leela Zero, whose weights of version 2 answer with
// Black's value. Rows from the bottom; the policy is y * size + x with a pass behind.
#pragma once

#include "engine/encoding.h"
#include "engine/go/go.h"

namespace go {

// The place of a move in such a policy.
int point_index(const Go& game, Move move);
// Of an encoding with so many planes, nothing beside them, and such a policy.
template <int planes>
engine::EncodingShape point_shape(const Go& game) {
    const int size = game.size();
    return {planes, size, size, 0, size * size + 1, 8};
}

engine::Encoding<Go> alphazero();
engine::Encoding<Go> leela_zero();
engine::Encoding<Go> leela_zero_black();  // "leela-zero-18-black"

}  // namespace go
