// The end of a game of Go as the engine reads it: which stones are dead, whose the points are,
// whether anything is left to play for. All answers about the end of a game (final_score,
// final_status_list, the SGF's result, the decision to pass) come from one Reading, so that they
// agree.
#pragma once

#include <array>
#include <vector>

#include "engine/go/go.h"
#include "engine/go/score.h"

namespace protocols {

// What a search saw of a position.
struct Look {
    std::vector<float> owners;  // expected, of each point (y * size + x) in [-1, 1], +1 Black
    float value = 0;            // of the position, in [-1, 1], as Black sees it
};
// With Black to move, and with White.
using Looks = std::array<Look, 2>;

// In half points.
int lead_of(engine::Player player, const go::Score& score);

// Whether the rules ask for agreement on dead stones after two passes.
bool agrees_on_dead_stones(const go::Rules& rules);

class Reading {
   public:
    Reading(const go::Go& game, const Looks& looks);

    // Stones that the final score takes off: all of a chain or none. None under rules that score
    // the board as it stands.
    const std::vector<go::Point>& dead() const { return dead_; }
    // Of the stone at `point`: dead where the final score gives the point to the opponent, in seki
    // where its group lives without territory beside a liberty shared with an enemy.
    go::Status status(go::Point point) const;
    std::vector<go::Point> stones(go::Status wanted) const;
    // With dead() off, under the game's rules.
    const go::Score& score() const { return score_; }

    // Stones that would be captured if the game were played to the end, whatever the rules say of
    // agreement; and the score once they are off.
    const std::vector<go::Point>& doomed() const { return doomed_; }
    const go::Score& played_out() const { return played_out_; }
    // Empty points that are nobody's once the doomed stones are off.
    const std::vector<go::Point>& neutral() const { return neutral_; }
    // No chain's and no territory's fate is in doubt or hangs on who moves next, and the borders
    // are closed: at most neutral points are left to fill.
    bool settled() const { return settled_; }
    // Winrate of `player` when it moves next, and when it passes.
    double winrate_moving(engine::Player player) const;
    double winrate_passing(engine::Player player) const;
    // All neutral points lie between stones: no side could still wall in more of them.
    bool borders_closed() const;

   private:
    void judge_chains(const Looks& looks);
    bool territory_agreed(const Looks& looks) const;

    go::Go game_;
    std::vector<go::Point> dead_, doomed_, neutral_;
    go::Score score_, played_out_;
    std::array<float, 2> values_;  // by who moves next, as Black sees them
    bool settled_ = true;
};

// Whether more than `share` of the board's points are empty.
bool is_emptier(const go::Go& game, double share);

// With two points in three empty, on 5x5 or more, there is something to play for whatever a network
// thinks of a pass: some take one in the past for the end of the game and pass on.
bool too_early_to_pass(const go::Go& game);

// What the side to move should choose from when the end has come.
struct Ending {
    bool pass = false;
    std::vector<go::Move> only;  // else among these; empty: any move

    bool restricts() const { return pass || !only.empty(); }
};

// For the mover of `game`, whose stones `reading` is about. It passes when that keeps a win or
// cannot lose more; before that it fills the neutral points that still count, and where the board
// is scored as it stands (or `clean_up` asks for it) captures what is doomed.
Ending ending(const go::Go& game, const Reading& reading, bool clean_up);

}  // namespace protocols
