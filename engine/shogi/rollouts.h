// Games of shogi played out by uniformly random legal moves on the bare position, for UCT. Holds
// nothing; any thread may call it.
#pragma once

#include "engine/rollout.h"
#include "engine/shogi/shogi.h"

namespace shogi {

class Rollouts {
   public:
    // A finished game has its own result. Repetition and declaration are not looked at on the way;
    // a rollout of `most_moves`, or one that reaches the game's own limit, is drawn.
    engine::RolloutResult play(const Shogi& from, engine::Random& random);

   private:
    static constexpr int most_moves = 512;
};

}  // namespace shogi
