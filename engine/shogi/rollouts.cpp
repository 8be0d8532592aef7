#include "engine/shogi/rollouts.h"

#include <algorithm>

#include "engine/shogi/movegen.h"

namespace shogi {

engine::RolloutResult Rollouts::play(const Shogi& from, engine::Random& random) {
    if (const Outcome outcome = from.outcome(); outcome != Outcome::ongoing)
        return {outcome, 0, {}};
    Position position = from.position();
    const int left = from.move_limit() > 0 ? from.move_limit() - from.move_count() : most_moves;
    for (int moves = std::min(left, most_moves); moves > 0; --moves) {
        const auto legal = shogi::legal_moves(position);
        if (legal.empty()) return {engine::win_for(~position.to_play()), 0, {}};
        position.play(legal[random.below(legal.size())]);
    }
    return {Outcome::draw, 0, {}};
}

}  // namespace shogi
