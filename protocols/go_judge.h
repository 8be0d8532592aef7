// Reads the end of a game of Go by searches of its own, small ones that leave the tree of the game
// being played alone. Remembers the last position it read: the stones decide, passes do not.
#pragma once

#include <optional>
#include <vector>

#include "engine/go/go.h"
#include "engine/go/rollouts.h"
#include "protocols/go_endgame.h"
#include "search/searcher.h"

namespace protocols {

class GoJudge {
   public:
    // Takes 16 MiB beside the memory that `params` allow.
    explicit GoJudge(const search::SearchParams& params);

    // Blocks, some tenths of a second at most; about `time` when given. One thread and one seed
    // give one reading, unless time runs out.
    Reading read(const go::Go& game, std::optional<search::Milliseconds> time = {});
    // A quick look, some milliseconds long (half a second on 19x19): whether the game may be at its
    // end. None at a board with five points in six empty, which is not.
    bool looks_over(const go::Go& game, std::optional<search::Milliseconds> time = {});
    // Whether the last reading had too little time to be relied on.
    bool hasty() const { return hasty_; }
    void set_params(const search::SearchParams& params);
    void forget() { read_.reset(); }
    // From any thread: cuts short a look that is under way.
    void interrupt() { searcher_.interrupt(); }

   private:
    Looks look(const go::Go& game, const search::Limits& limits);
    Look look_after(const go::Go& game, engine::Player mover, const search::Limits& limits);

    search::Searcher<go::Go> searcher_;
    std::optional<go::Go> read_;  // the stones that `looks_` are at
    Looks looks_;
    bool hasty_ = false;
};

// The stones of `game` with nothing played before them: no passes, no ko, no repetition.
go::Go without_history(const go::Go& game);

// Whether a search with a network bears out what was made of a reading, which comes from games
// played out and is easily fooled: they must agree on who wins, and where the board is scored as it
// stands the ending may not cost more than little. True without a network, and of an ending that
// leaves every move. Blocks for two looks of up to `time`; `searcher` keeps what it has found below
// `root`, the position with the mover to move.
bool bears_out(search::Searcher<go::Go>& searcher, const go::Go& root, const Reading& reading,
               const Ending& ending, std::optional<search::Milliseconds> time = {});

}  // namespace protocols
