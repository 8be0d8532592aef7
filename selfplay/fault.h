// What a player of a match did wrong. A Fault loses the game, and is caught where one game is
// played (selfplay/match_game.cpp) and nowhere else.
#pragma once

#include <chrono>
#include <stdexcept>
#include <string>

namespace selfplay {

using Clock = std::chrono::steady_clock;
using Deadline = Clock::time_point;

class Fault : public std::runtime_error {
   public:
    // `protocol`: an answer that its protocol does not allow, or a refusal of what must be taken.
    // `stopped` is nobody's fault: the match is ending.
    enum class Kind { crash, hang, protocol, stopped };
    Fault(Kind what, const std::string& detail) : std::runtime_error(detail), kind(what) {}

    Kind kind;
};

}  // namespace selfplay
