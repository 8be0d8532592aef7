// The end of a game of Go as the engine reads it: which stones are dead, whose the points are,
// whether there is anything left to play for. All answers of a front end about the end of a game
// (final_score, final_status_list, the SGF's result, the decision to pass) come from one Reading,
// so that they agree.
#pragma once

#include <string>
#include <vector>

#include "engine/go/go.h"
#include "engine/go/score.h"

namespace protocols {

class Reading {
   public:
    // `owners`: expected owner of each point (y * size + x) in [-1, 1], +1 Black, over many games
    // played out from `game`.
    Reading(const go::Go& game, const std::vector<float>& owners);

    // Stones that will be taken off: all of a chain or none. Empty under rules that score the
    // board as it stands.
    const std::vector<go::Point>& dead() const { return dead_; }
    // Of the chain with a stone at `point`.
    go::Status status(go::Point point) const;
    std::vector<go::Point> stones(go::Status wanted) const;
    // The board with the dead stones off, under the game's rules.
    const go::Score& score() const { return score_; }
    // Every point's owner is beyond doubt, and the score counts it so: no move can gain anything.
    bool settled() const { return settled_; }

   private:
    go::Go game_;
    std::vector<float> chain_owner_;  // per point with a stone: its chain's mean, +1 its own colour
    std::vector<go::Point> dead_;
    go::Score score_;
    bool settled_ = false;
};

// Whether the rules ask for agreement on dead stones after two passes.
bool agrees_on_dead_stones(const go::Rules& rules);

// Empty points beside those of `stones` that are `owner`'s, each once.
std::vector<go::Point> liberties_of(const go::Go& game, const std::vector<go::Point>& stones,
                                    engine::Player owner);

// Whether the mover should pass: the game is decided, passing keeps what it has, and (where the
// board is scored as it stands) nothing dead is left to be counted as alive.
bool should_pass(const go::Go& game, const Reading& reading);

}  // namespace protocols
