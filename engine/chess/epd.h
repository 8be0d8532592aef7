// Extended position description: problems with their answers, one a line, as test suites have them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/chess/chess.h"

namespace chess {

struct Problem {
    struct Points {
        Move move;
        int points = 0;
    };

    Chess game;
    std::string id;
    std::vector<Move> best, avoid;    // bm, am
    std::optional<int> mate_in;       // dm: full moves
    std::vector<Points> points;       // c0 "f5=10, Be5+=2" (STS), else empty
    std::vector<std::string> others;  // the other operations, as written
};

// Reads four fields of FEN, or six, and operations that end with ";". Moves are SAN or UCI.
// Fails with engine::Error when the position or a move of bm or am is bad.
Problem problem_from_epd(std::string_view line);

}  // namespace chess
