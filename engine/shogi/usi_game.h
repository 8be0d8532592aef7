// Games of shogi as lines of USI: "position startpos moves 7g7f 3c3d", "sfen … moves …".
#pragma once

#include <string>
#include <string_view>

#include "engine/shogi/record.h"

namespace shogi {

// The words "position" and "sfen" may be missing, and so may the moves. Fails with engine::Error,
// naming the move by its number where one is bad.
Record parse_usi_game(std::string_view line);
// The main line, as behind "position".
std::string to_usi_game(const Record& record);

}  // namespace shogi
