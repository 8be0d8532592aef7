// One game of a match: two players, our referee and our clocks. A fault of a player loses it the
// game and is written down under the player's name; it never escapes.
#pragma once

#include <array>
#include <stop_token>

#include "selfplay/game_record.h"
#include "selfplay/player.h"
#include "selfplay/rulebook.h"

namespace selfplay {

using search::Milliseconds;

// Ends games early by what both engines say of them; off while `moves` is 0.
struct Adjudication {
    int draw_moves = 0;    // so many moves of each side in a row within ±draw_score …
    int draw_score = 10;   // centipawns
    int draw_from = 40;    // … from this move number of each side on
    int resign_moves = 0;  // so many moves in a row of the loser at -resign_score or worse
    int resign_score = 1000;
    bool operator==(const Adjudication&) const = default;
};

struct GameRules {
    std::array<search::TimeControl, 2> time;  // by engine
    Milliseconds margin{0};                   // may be overstepped without loss
    Milliseconds grace{5000};             // past the clock, until a silent engine counts as hung
    Milliseconds move_timeout{300000};    // the same for moves without a clock
    Milliseconds start_timeout{120000};   // until an engine has started: some load for a minute
    Milliseconds command_timeout{30000};  // for every other answer
    int move_limit = 0;                   // opening included; 0: none
    Adjudication adjudication;
    bool operator==(const GameRules&) const = default;
};

// What the schedule says of a game before it begins.
struct GameOrder {
    int index = 0;
    int first = 0;  // which engine moves first
    std::array<std::string, 2> names{};
    Opening opening;
};

// `players`: engine 0 and engine 1. Throws Fault only of kind `stopped`. `faulty` tells which
// engine must be started anew (crashed, hung, or out of step), -1: none.
struct PlayedGame {
    GameRecord record;
    int faulty = -1;
};
PlayedGame play_game(const Rulebook& rulebook, const GameRules& rules, const GameOrder& order,
                     const std::array<Player*, 2>& players);
// The record of a game that an engine lost by failing to start. Rethrows a stop.
PlayedGame forfeit(const GameOrder& order, int engine, const Fault& fault);

}  // namespace selfplay
