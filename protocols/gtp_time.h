// The clocks of a game of Go as GTP's commands set them.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "engine/game.h"
#include "search/clock.h"

namespace protocols {

class GtpClock {
   public:
    // Main time never grows past `most_main`, and no move takes more than `most_a_move`.
    struct Caps {
        std::optional<search::Milliseconds> most_main, most_a_move;
    };

    // Both sides start with all of it.
    void set(const search::TimeControl& control, const Caps& caps = {});
    void restart() { set(control_, caps_); }
    // GTP time_left: `seconds` of main time when `stones` is 0, else of the running period.
    void set_left(engine::Player player, double seconds, int stones);
    void spend(engine::Player player, search::Milliseconds used);

    const search::TimeControl& control() const { return control_; }
    const search::TimeLeft& left(engine::Player player) const {
        return left_[static_cast<std::size_t>(player)];
    }
    // What a move may be thought about with: no more than the caps allow.
    search::TimeLeft for_a_move(engine::Player player) const;

   private:
    search::TimeControl control_;
    Caps caps_;
    std::array<search::TimeLeft, 2> left_;
};

}  // namespace protocols
