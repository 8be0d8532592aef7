// CSA, the notation of computer shogi tournaments (version 2.2, computer-shogi.org/protocol).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/shogi/record.h"

namespace shogi::csa {

// All games of a file ("/" stands between two), in UTF-8, Shift_JIS or EUC-JP. A game without a
// position starts from the usual one. Lines that begin with "#", a server's, are passed over.
// Facts are named as behind "$". Fails with engine::Error naming game, line and, where a move is
// bad, its number.
std::vector<Record> parse(std::string_view bytes);

// The main line; CSA has no variations.
std::string to_text(const Record& record);

// "+7776FU", "-0055KA": the move as the mover of `position` makes it, legal or not.
std::string to_csa(const Position& position, Move move);
// Empty when the text is no move of the mover's.
std::optional<Move> parse_csa_move(const Position& position, std::string_view text);

}  // namespace shogi::csa
