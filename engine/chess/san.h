// Standard algebraic notation, as books and PGN write moves: written exactly, read with patience.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/chess/position.h"

namespace chess {

// The shortest unambiguous form with + or #: "Nf3", "R1xa3", "exd8=Q#", "O-O-O". `move` must be
// legal.
std::string san(const Position& position, Move move);

// Empty when the text is no move, no legal one, or could be more than one. Understood beyond the
// standard: missing or wrong + # x =, annotations (!?), needless origins, long forms (e2-e4, e2e4,
// Ng1-f3), 0-0, e8Q, e8(Q), exd6e.p.
std::optional<Move> move_from_san(const Position& position, std::string_view text);

// The same, and moves as UCI writes them.
std::optional<Move> move_from_san_or_uci(const Position& position, std::string_view text);

}  // namespace chess
