// Games of Go played out at random on a board of their own, for UCT: neither player fills its own
// one-point eyes, both pass only when nothing else is left, and the stones on the board are scored.
// One a thread.
#pragma once

#include <array>

#include "engine/go/go.h"
#include "engine/rollout.h"

namespace go {

class Rollouts {
   public:
    // Superko is not looked at, and a rollout of 3 * size * size moves is cut off and scored as it
    // stands. Under territory rules the lead is the area's less what Black played more than White
    // before the rollout. A finished game has its own result.
    engine::RolloutResult play(const Go& from, engine::Random& random);

   private:
    template <int most_size>
    int play_on(const Go& from, engine::Random& random);
    engine::RolloutResult finished(const Go& game);

    std::array<std::int8_t, most_points> owners_;
    std::array<std::int8_t, (max_size + 1) * (max_size + 1)> firsts_{};  // by index, edges 0
};

}  // namespace go
