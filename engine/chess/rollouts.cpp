#include "engine/chess/rollouts.h"

namespace chess {

engine::RolloutResult Rollouts::play(const Chess& from, engine::Random& random) const {
    if (const auto outcome = from.outcome(); outcome != Outcome::ongoing) return {outcome, 0, {}};
    Position position = from.position();
    for (int moves = 0; moves < most_moves; ++moves) {
        const auto legal = position.legal_moves();
        if (legal.empty()) {
            if (!position.in_check()) break;
            return {engine::win_for(~position.to_play()), 0, {}};
        }
        if (position.halfmove_clock() >= 100 || position.insufficient_material()) break;
        position.play(legal[random.below(legal.size())]);
    }
    return {Outcome::draw, 0, {}};
}

}  // namespace chess
