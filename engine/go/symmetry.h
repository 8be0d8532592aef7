// The eight symmetries of the board. For the networks' evaluators and for tests.
#pragma once

#include <cassert>
#include <utility>

#include "engine/go/go.h"

namespace go {

inline constexpr int symmetries = 8;

// Symmetry 0..7 is three bits: 4 exchanges columns and rows, then 2 mirrors the columns and 1 the
// rows. 0 changes nothing.
constexpr Point transformed(Point point, int size, int symmetry) {
    assert(symmetry >= 0 && symmetry < symmetries);
    if ((symmetry & 4) != 0) std::swap(point.x, point.y);
    if ((symmetry & 2) != 0) point.x = size - 1 - point.x;
    if ((symmetry & 1) != 0) point.y = size - 1 - point.y;
    return point;
}

// The one that leads back: all but the two quarter turns undo themselves.
constexpr int inverse_symmetry(int symmetry) {
    return symmetry == 5 ? 6 : symmetry == 6 ? 5 : symmetry;
}

// The same move on the turned board.
inline Move transformed(const Go& game, Move move, int symmetry) {
    const auto point = game.point_of(move);
    return point ? game.move_at(transformed(*point, game.size(), symmetry)) : move;
}

}  // namespace go
