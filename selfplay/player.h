// One side of a match, whoever it is: an external engine behind its protocol, or our own search in
// process. Moves and positions cross this line as text in the game's own notation (vertices in Go,
// UCI and USI moves), so a match never learns how a player thinks. One owner, one thread; every
// call blocks, at most until its deadline, and throws Fault when the player fails.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/game.h"
#include "search/clock.h"
#include "selfplay/fault.h"
#include "selfplay/go_conditions.h"

namespace selfplay {

// What a player is told before a game.
struct GameSetup {
    std::string game = "go";
    GoConditions go;
    std::string start;      // a position as the game writes it; empty: the game's own
    bool chess960 = false;  // castling is written as the king taking its rook
    search::TimeControl time;
};

// Both clocks, by player, just before a move.
using Clocks = std::array<search::TimeLeft, 2>;

struct Answer {
    enum class Kind { move, resign, claim_win };  // claim_win: shogi's declaration
    Kind kind = Kind::move;
    std::string move;
    std::optional<int> centipawns;  // the player's own judgement from its side, if it told
};

class Player {
   public:
    virtual ~Player() = default;

    // Empty when the player does not say.
    virtual std::string name() const = 0;
    virtual void new_game(const GameSetup& setup, engine::Player side, Deadline deadline) = 0;
    // A legal move that was made: of the opening or of the opponent, never the player's own.
    virtual void play(engine::Player mover, std::string_view move, Deadline deadline) = 0;
    virtual Answer think(engine::Player mover, const Clocks& clocks, Deadline deadline) = 0;
    // Go, after two passes: vertices of all dead stones; empty when it cannot say.
    virtual std::optional<std::vector<std::string>> dead_stones(Deadline) { return std::nullopt; }
    virtual void game_over(engine::Outcome, Deadline) {}
};

// What the user fixes for one side.
struct PlayerSettings {
    std::string command;
    std::string protocol = "gtp";         // gtp, uci, usi, xboard, gnushogi, internal
    std::string name;                     // empty: as the player says
    std::vector<std::string> init;        // lines sent as they are once the engine has started
    std::optional<std::uint64_t> visits;  // thinks so much a move instead of by the clock
    std::string log;                      // file for the engine's stderr
};

}  // namespace selfplay
