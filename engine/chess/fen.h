// Forsyth-Edwards Notation, in and out: FEN, X-FEN and Shredder-FEN, told apart by the castling
// field (KQkq = the outermost rook on that side, A-H and a-h = the rook on that file).
#pragma once

#include <string>
#include <string_view>

#include "engine/chess/position.h"

namespace chess {

// The counters may be missing (they are 0 and 1 then), the castling and en passant fields too.
// Fails with engine::Error that says which field is wrong and why, or why nobody could play on.
Position position_from_fen(std::string_view text);

// X-FEN: the same as FEN except where a castling rook is not the outermost on its side; then
// its file is named. The en passant square is there only when a pawn may capture on it.
std::string fen(const Position& position);
// The first four fields, as EPD has them.
std::string fen_without_counters(const Position& position);

// "e4"; empty when the text is not a square.
std::optional<Square> square_from_text(std::string_view text);
std::string square_text(Square square);
// The letter of a piece in English, upper case: P N B R Q K.
char piece_letter(Piece piece);
// Either case.
std::optional<Piece> piece_from_letter(char letter);

}  // namespace chess
