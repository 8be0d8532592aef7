// One finished game of a match, as it is written to games.jsonl and read back on resuming.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "engine/game.h"

namespace selfplay {

// A beginning that both sides play from: a position (empty: the game's own) and moves from there.
struct Opening {
    std::string start;
    std::vector<std::string> moves;
    bool operator==(const Opening&) const = default;
};

struct GameRecord {
    int index = 0;                       // from 0, in the order of the schedule
    int first = 0;                       // which engine (0 or 1) moves first
    std::array<std::string, 2> names{};  // of engine 0 and engine 1
    std::string event = "sanban match";  // as game files call it; not kept in games.jsonl
    std::string start;
    std::vector<std::string> moves;  // opening included
    int opening_moves = 0;
    std::vector<int> milliseconds;  // measured, one a move after the opening
    engine::Outcome outcome = engine::Outcome::draw;
    // "score", "resignation", "time", "crash", "hang", "illegal move", "protocol error",
    // "move limit", "no result", "rules", "adjudication" …
    std::string reason;
    std::string score;              // "B+3.5", where the game counts points and came to its end
    std::string detail;             // what exactly went wrong
    std::vector<std::string> dead;  // taken off before counting
    bool operator==(const GameRecord&) const = default;

    // 0 or 1; -1 for a draw.
    int winner() const;
    // Lost by a crash, a hang, an illegal move, a protocol error or the clock.
    bool by_fault() const;
    const std::string& name_of(engine::Player player) const;
};

// One line of JSON, without line end.
std::string to_json(const GameRecord& record);
// Fails with engine::Error.
GameRecord record_from_json(std::string_view line);

}  // namespace selfplay
