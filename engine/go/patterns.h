// The 3x3 patterns that a rollout plays by: hane, cuts and their like at the board's edge, as
// MoGo's (Gelly, Wang, Munos & Teytaud 2006, "Modification of UCT with patterns in Monte-Carlo
// Go").
#pragma once

#include <bitset>
#include <cstdint>

#include "engine/go/board.h"

namespace go {

class Patterns {
   public:
    static const Patterns& all();

    // Whether a move of `mover`, black or white, fits a pattern there; `surroundings` as
    // RolloutBoard tells them.
    template <Colour mover>
    bool fit(std::uint16_t surroundings) const {
        return (mover == Colour::black ? black_ : white_)[surroundings];
    }

   private:
    Patterns();

    std::bitset<65536> black_, white_;
};

}  // namespace go
