// Games played out by a default policy: the leaf value of UCT and half of AlphaGo's.
//
// A game that can do better than uniformly random legal moves (a faster board, own eyes left
// alone) names its own type `Rollouts`, with working memory inside, one a thread.
#pragma once

#include <vector>

#include "engine/base/random.h"
#include "engine/game.h"

namespace engine {

struct RolloutResult {
    Outcome outcome = Outcome::draw;  // ongoing where it ended before the game did
    float lead =
        0;  // points by which the first player leads, komi counted; 0 in games without points
    // A point's owner at the end, +1 first player, -1 second, 0 nobody, in the game's own order
    // of points; empty in games without territory. Valid until the next rollout.
    std::span<const std::int8_t> owners;
    // Who made a move first in the rollout, by the move's code: +1 first player, -1 second, 0
    // nobody; empty in games that keep no such account. Valid until the next rollout.
    std::span<const std::int8_t> firsts = {};
    // Of an ongoing one: what the first player may expect, in [-1, 1].
    float expectation = 0;
};

template <Game G>
class UniformRollouts {
   public:
    // `from` may be a finished game: then the result is its own. Stops with a draw after
    // `max_moves`, far longer than any sensible game.
    RolloutResult play(const G& from, Random& random) {
        G game = from;
        for (int moves = 0; moves < max_moves && game.outcome() == Outcome::ongoing; ++moves) {
            const auto legal = game.legal_moves();
            game.play(legal[random.below(legal.size())]);
        }
        const auto outcome = game.outcome();
        return {outcome == Outcome::ongoing ? Outcome::draw : outcome, 0, {}, {}};
    }

   private:
    static constexpr int max_moves = 1000;
};

template <class G>
struct RolloutsOf {
    using type = UniformRollouts<G>;
};
template <class G>
requires requires { typename G::Rollouts; }
struct RolloutsOf<G> {
    using type = typename G::Rollouts;
};

// What plays a position out beside a network: rollouts, or where the game has a type `Exchanges`,
// the captures alone, which say at once what random moves would not.
template <class G>
struct PlayoutsOf : RolloutsOf<G> {};
template <class G>
requires requires { typename G::Exchanges; }
struct PlayoutsOf<G> {
    using type = typename G::Exchanges;
};
// Whether they are left to chance, so that another from the same position may end otherwise.
template <class G>
inline constexpr bool playouts_vary = !requires {
    typename G::Exchanges;
};

// Rollouts whose policy also weighs moves for the tree: one positive weight a move, 1 where nothing
// is known of it.
template <class R, class G>
concept WeighsMoves = requires(const R rollouts, const G game, std::vector<float> weights) {
    rollouts.weigh(game, game.legal_moves(), weights);
};

}  // namespace engine
