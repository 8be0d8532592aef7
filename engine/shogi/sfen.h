// SFEN, the one-line form of a shogi position: board by ranks from the top, mover, hands and the
// number of the next move, as in
// "lnsgkgsnl/1r5b1/ppppppppp/9/9/9/PPPPPPPPP/1B5R1/LNSGKGSNL b - 1".
#pragma once

#include <string>
#include <string_view>

#include "engine/shogi/position.h"

namespace shogi {

struct Sfen {
    Position position;
    int next_move = 1;
};

// Takes "startpos" too, and a line without its last field. Fails with engine::Error, saying why,
// where the text is malformed or the position fails `check`.
Sfen parse_sfen(std::string_view text);
std::string to_sfen(const Position& position, int next_move = 1);

// Fails, saying why, on a position that no game or mate problem can have: two kings of a player,
// no king at all (a mate problem's attacker may lack one), more pieces than a set has, two pawns
// of a player on a file, a piece that could never move, or the player not to move in check.
void check(const Position& position);

// "P", "+p" …: White's pieces in small letters, an empty square as nothing.
std::string letters(Piece piece);

}  // namespace shogi
