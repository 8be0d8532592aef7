// The legal moves of a shogi position: pins, checks, two pawns on a file, pieces without a move
// and drop-pawn mate all counted, and non-promotions included wherever the rules allow them.
// Repetition is not looked at. Any thread may call these.
#pragma once

#include "engine/game.h"
#include "engine/shogi/position.h"

namespace shogi {

engine::MoveList legal_moves(const Position& position);
// Those of them that capture, and pawns that promote; where a move may promote, only promoting.
engine::MoveList captures(const Position& position);
// Those of them that give check.
engine::MoveList checks(const Position& position);
// As many as legal_moves would list, in a fraction of the time.
int count_legal_moves(const Position& position);
bool has_legal_move(const Position& position);

template <Player us>
engine::MoveList legal_moves_as(const Position& position);
template <Player us>
int count_legal_moves_as(const Position& position);

}  // namespace shogi
