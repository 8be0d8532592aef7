// Keeps resignation honest (Silver et al. 2017): from games played to their end it knows how often
// a side that would have given up did not lose after all, and lets the threshold be no higher than
// keeps that rare. Belongs to one thread.
#pragma once

#include <cstddef>
#include <deque>

#include "selfplay/records/game.h"

namespace selfplay::training {

class ResignWatch {
   public:
    // `highest`: threshold that is never exceeded, -1 to have no resignation at all. `turns`: of a
    // side in a row that must lie below it. `errors`: most of those given up that may have been
    // saved.
    ResignWatch(float highest, int turns, float errors);

    // A game played to its end although resignation might have ended it before.
    void add(const records::Game& game);

    // Value for the mover below which to give up; -1, never, until enough games are known.
    float threshold() const { return threshold_; }
    // Of the latest games played on: those that `threshold` would have ended, and those of them
    // that the side giving up did not lose.
    std::size_t given_up() const { return count(threshold_).given_up; }
    std::size_t saved() const { return count(threshold_).saved; }
    // The share of them; 0 when there are none.
    double error_rate() const;

   private:
    // The values at which resignation would have struck: once any threshold lies above them.
    struct Lows {
        float loser = 1, other = 1;  // other: the winner, or either side of a draw
    };
    struct Count {
        std::size_t given_up = 0, saved = 0;
    };
    Count count(float threshold) const;
    void settle();

    static constexpr std::size_t remembered = 400, enough = 40;

    float highest_, threshold_ = -1;
    int turns_;
    float errors_;
    std::deque<Lows> games_;
};

// The lowest value that a side's search had held for `turns` turns of its own in a row: the
// smallest over the game of the largest of so many; 1 where it had not so many turns.
float lowest_held(const records::Game& game, engine::Player player, int turns);

}  // namespace selfplay::training
