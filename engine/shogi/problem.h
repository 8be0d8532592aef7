// Shogi problems with their answers, one a line: an SFEN, and behind it operations as in EPD, whose
// moves are USI's. A line without any is a mate problem, as collections of these are.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/shogi/shogi.h"

namespace shogi {

struct Problem {
    Shogi game;
    std::string id;
    std::vector<Move> best, avoid;  // bm, am
    std::optional<int> mate_plies;  // dm: of both players' moves
};

// "[position] [sfen] BOARD TURN HANDS [PLY] [;] [bm 7g7f; am 2g2f; dm 5; id "…";]"; operations of
// other names are passed over. Fails with engine::Error when the position or a move of bm or am is
// bad.
Problem problem_from_sfen(std::string_view line);

}  // namespace shogi
