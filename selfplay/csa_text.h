// A finished game of shogi in CSA format, version 2.2 (www2.computer-shogi.org/protocol), as a
// match writes it down.
#pragma once

#include <string>

#include "selfplay/game_record.h"

namespace selfplay {

// `record` is of a game of shogi; its moves are legal. Of several games in a file all but the first
// follow a line "/".
std::string to_csa(const GameRecord& record);

}  // namespace selfplay
