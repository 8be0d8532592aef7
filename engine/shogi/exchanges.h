// A position of shogi when the captures that pay have been played: material on the board and in
// hand, as chances of winning. Holds nothing; any thread may call it.
#pragma once

#include "engine/base/random.h"
#include "engine/rollout.h"
#include "engine/shogi/shogi.h"

namespace shogi {

class Exchanges {
   public:
    // A finished game has its own result.
    engine::RolloutResult play(const Shogi& from, engine::Random& random) const;
};

// What the mover has more than the other once captures have been played out; a pawn is 90.
int settled_material(const Position& position);

}  // namespace shogi
