// The clocks of a game of Go as GTP's commands set them.
#pragma once

#include <array>
#include <string>

#include "engine/game.h"
#include "search/clock.h"

namespace protocols {

class GtpClock {
   public:
    // Both sides start with all of it.
    void set(const search::TimeControl& control);
    void restart() { set(control_); }
    // GTP time_left: `seconds` of main time when `stones` is 0, else of the running period.
    void set_left(engine::Player player, double seconds, int stones);
    void spend(engine::Player player, search::Milliseconds used);

    const search::TimeControl& control() const { return control_; }
    const search::TimeLeft& left(engine::Player player) const {
        return left_[static_cast<std::size_t>(player)];
    }

   private:
    search::TimeControl control_;
    std::array<search::TimeLeft, 2> left_;
};

}  // namespace protocols
