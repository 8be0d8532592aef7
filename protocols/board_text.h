// Chess and shogi for a person at a terminal: boards with their coordinates, and a game as the file
// that other programs read.
#pragma once

#include <span>
#include <string>

#include "engine/chess/chess.h"
#include "engine/shogi/shogi.h"

namespace protocols {

// The last line is the position as text.
std::string diagram(const chess::Chess& game);
std::string diagram(const shogi::Shogi& game);

// PGN, or CSA (KIF where `kif`), of a game that went through these states, the start first. With
// `resigned` the player to move has given up.
std::string to_pgn(std::span<const chess::Chess> states, bool resigned);
std::string to_shogi_record(std::span<const shogi::Shogi> states, bool resigned, bool kif);

}  // namespace protocols
