// Games of chess played out by uniformly random legal moves, for UCT. They know mate, stalemate,
// dead material and the 50-move rule, but not repetition, which random play hardly ever meets and
// which a history of keys would have to be kept for. One a thread.
#pragma once

#include "engine/base/random.h"
#include "engine/chess/chess.h"
#include "engine/rollout.h"

namespace chess {

class Rollouts {
   public:
    // A finished game has its own result. A draw after `most_moves`.
    engine::RolloutResult play(const Chess& from, engine::Random& random) const;

   private:
    static constexpr int most_moves = 1000;
};

}  // namespace chess
