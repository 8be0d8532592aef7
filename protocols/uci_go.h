// The `go` command of UCI and USI: what it says, and the limits of a think that follow from it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/game.h"
#include "search/limits.h"

namespace protocols {

// A week: longer times only risk overflow.
inline constexpr std::uint64_t most_milliseconds = std::uint64_t{7} * 24 * 3600 * 1000;

struct GoCommand {
    // By player: Player::first is White in chess (wtime) and Black in shogi (btime).
    std::array<std::optional<search::Milliseconds>, 2> time;
    std::array<search::Milliseconds, 2> increment{};
    search::Milliseconds byoyomi{0};
    int moves_to_go = 0;
    std::optional<search::Milliseconds> move_time;
    std::optional<std::uint64_t> nodes;
    std::optional<int> depth;
    // Moves (UCI) or milliseconds (USI) for a mate search.
    std::optional<std::uint64_t> mate;
    bool infinite = false, ponder = false;
    std::vector<std::string> search_moves;

    bool has_clock() const { return time[0] || time[1] || byoyomi.count() > 0; }
};

// `white_first`: whether wtime is the first player's. Unknown words are passed over and malformed
// numbers ignored, as UCI asks; negative times count as none left.
GoCommand parse_go(std::string_view arguments, bool white_first);

// What a move costs on the clock beyond its thought, in the GUI, on the way, or waiting for a
// processor: the times that a side is shown tell it.
class ClockLag {
   public:
    // With each go: the mover's clock.
    void shown(const search::TimeLeft& left);
    // When its move is out.
    void answered(search::Milliseconds thought) { thought_ = thought; }
    // The next go is of another game.
    void forget_game() { last_.reset(); }

    search::Milliseconds mean() const;
    // The clock as it would be without what the moves to come will cost beyond their thought.
    search::TimeLeft without_lag(search::TimeLeft left) const;

   private:
    std::optional<search::TimeLeft> last_;
    std::optional<search::Milliseconds> thought_;
    double mean_ = 0;  // milliseconds
};

// The limits but for search_moves, which only the game can read.
search::Limits limits_of(const GoCommand& go, engine::Player mover);

}  // namespace protocols
