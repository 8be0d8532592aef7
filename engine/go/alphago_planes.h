// The encodings of Go that AlphaGo's networks saw (Silver et al. 2016): 48 planes of stones, ages
// and tactics for the policy, and one more, the mover's colour, for the value. Rows from the
// bottom; the policy is y * size + x with a pass behind.
#pragma once

#include "engine/encoding.h"
#include "engine/go/go.h"

namespace go {

// The planes in order. Groups of eight show a number in one of 1 .. 7 and "8 or more". What a move
// would do is told at the points of legal moves.
namespace alphago {
inline constexpr int own = 0, enemy = 1, empty = 2, ones = 3;
inline constexpr int turns_since = 4;       // of the stone there
inline constexpr int liberties = 12;        // of the chain there
inline constexpr int capture_size = 20;     // stones that a move takes
inline constexpr int self_atari_size = 28;  // stones of the chain that it leaves in atari
inline constexpr int liberties_after = 36;  // of the chain that it makes
inline constexpr int ladder_capture = 44, ladder_escape = 45;
inline constexpr int sensible = 46;  // legal, and fills no own eye
inline constexpr int zeros = 47, policy_planes = 48;
inline constexpr int colour = 48, value_planes = 49;  // 1 where Black is to play
}  // namespace alphago

engine::Encoding<Go> alphago_policy();  // "alphago48"
engine::Encoding<Go> alphago_value();   // "alphago49"

}  // namespace go
