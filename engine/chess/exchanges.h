// A position of chess when the captures that pay have been played: material, as chances of winning.
// Holds nothing; any thread may call it.
#pragma once

#include "engine/base/random.h"
#include "engine/chess/chess.h"
#include "engine/rollout.h"

namespace chess {

class Exchanges {
   public:
    // A finished game has its own result.
    engine::RolloutResult play(const Chess& from, engine::Random& random) const;
};

// What the mover has more than the other once captures have been played out, in centipawns.
int settled_material(const Position& position);

}  // namespace chess
