// Moves and games as USI writes them: "7g7f", "8h2b+", "P*5e"; "startpos moves 7g7f …".
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/shogi/move.h"

namespace shogi {

// What the text says, legal or not; empty when it is no move.
std::optional<Move> parse_usi_move(std::string_view text);
std::string to_usi(Move move);
// "7g"
std::string to_usi(int square);

}  // namespace shogi
