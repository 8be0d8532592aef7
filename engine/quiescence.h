// Captures played out to the end, material counted: what a position without its tactics is worth
// (quiescence search; Beal, "A Generalised Quiescence Search Algorithm", 1990). A game names its
// own type `Exchanges` for it, the counterpart of rollouts in games that captures decide.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <span>

#include "engine/game.h"
#include "engine/rollout.h"

namespace engine {

// What a game tells of a position; material in a unit of its own, as the mover sees it.
template <class R>
concept Trades = requires(const typename R::Position position, Move move) {
    { R::material(position) } -> std::same_as<int>;
    // What the move wins at once, whatever it may cost.
    { R::gain(position, move) } -> std::same_as<int>;
    // Moves that win material at once; those of a higher rank are tried first.
    { R::captures(position) } -> std::same_as<MoveList>;
    { R::rank(position, move) } -> std::same_as<int>;
    { R::in_check(position) } -> std::same_as<bool>;
    { R::legal_moves(position) } -> std::same_as<MoveList>;
};

// Fail-soft alpha-beta over captures, in which a side may stop whenever it likes, and in the first
// plies over all moves out of check. Holds nothing; any thread may call it.
template <Trades R>
class Quiescence {
   public:
    using Position = typename R::Position;
    static constexpr int infinite = 1 << 20, mate = infinite / 2;

    // The material that the mover can come to; -mate when it is mated.
    static int search(const Position& position) {
        return search(position, R::material(position), -infinite, infinite, most_plies);
    }

   private:
    static constexpr int most_plies = 10, plies_of_checks = 4, most_moves = 128;

    static int search(const Position& position, int material, int alpha, int beta, int plies) {
        const bool evades = plies > most_plies - plies_of_checks && R::in_check(position);
        int best = -infinite;
        if (!evades) {
            best = material;
            if (best >= beta || plies == 0) return best;
        }
        alpha = std::max(alpha, best);
        const auto moves = evades ? R::legal_moves(position) : R::captures(position);
        if (evades && moves.empty()) return -mate;
        std::array<int, most_moves> room;  // NOLINT: filled as far as it is read
        const auto ranks =
            std::span(room).first(static_cast<std::size_t>(std::min(moves.size(), most_moves)));
        for (int i = 0; int& rank : ranks) rank = R::rank(position, moves[i++]);
        for (std::size_t tried = 0; tried < ranks.size(); ++tried) {
            const auto next_best = std::max_element(ranks.begin(), ranks.end());
            const Move move = moves[static_cast<int>(next_best - ranks.begin())];
            *next_best = std::numeric_limits<int>::min();
            const int gain = R::gain(position, move);
            // It would change nothing even if it cost nothing.
            if (!evades && material + gain <= alpha) {
                best = std::max(best, material + gain);
                continue;
            }
            Position next = position;
            next.play(move);
            const int value = -search(next, -(material + gain), -beta, -alpha, plies - 1);
            if (value <= best) continue;
            best = value;
            if (best >= beta) break;
            alpha = std::max(alpha, best);
        }
        return best;
    }
};

// The captures of a game as a playout; a finished one has its own result. `scale`: of the material
// in the chances of winning, tanh(material / scale).
template <Trades R, class G>
RolloutResult play_captures(const G& game, float scale) {
    if (const auto outcome = game.outcome(); outcome != Outcome::ongoing) return {outcome, 0, {}};
    const int settled = Quiescence<R>::search(game.position());
    const float value = std::tanh(static_cast<float>(settled) / scale);
    RolloutResult result;
    result.outcome = Outcome::ongoing;
    result.expectation = game.to_play() == Player::first ? value : -value;
    return result;
}

}  // namespace engine
