// KIF, the notation of Japanese shogi programs and servers, and KI2, its form for print: reading
// both, writing KIF, in UTF-8 and Shift_JIS.
#pragma once

#include <string>
#include <string_view>

#include "engine/shogi/record.h"

namespace shogi::kif {

// The game of a file in UTF-8 (with or without byte order mark) or Shift_JIS, KIF or KI2, with its
// variations. Facts are the headings that say nothing of the start or the players. Lines that
// mean nothing are passed over before the first move and refused after it. Fails with
// engine::Error naming the line and, where a move is bad, its number.
Record parse(std::string_view bytes);

// In UTF-8.
std::string to_text(const Record& record);
// What Shift_JIS cannot write becomes '?'.
std::string to_shift_jis(const Record& record);

// "７六歩(77)", "同　銀成(31)", "５五角打": `before` is the move before it, {} if none.
std::string to_kif(const Position& position, Move move, Move before);

}  // namespace shogi::kif
