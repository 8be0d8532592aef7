// Writes planes of a chess board one behind the other, as the mover sees them. A value of one
// owner; the planes must outlive it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "engine/chess/position.h"

namespace chess {

// Black's board is turned by ranks, files staying where they are.
inline Square seen_by(Player player, Square square) {
    return player == Player::first ? square : square ^ 56;
}

class PlaneWriter {
   public:
    PlaneWriter(std::span<float> planes, Player mover) : planes_(planes), mover_(mover) {
        std::fill(planes_.begin(), planes_.end(), 0.0f);
    }

    void set(Bitboard squares) {
        while (squares != 0) planes_[index(seen_by(mover_, pop(squares)))] = 1;
        skip(1);
    }
    void full(float value) {
        if (value != 0) std::fill_n(planes_.begin(), 64, value);
        skip(1);
    }
    // Six planes of the mover's men and six of the opponent's; of a Position or a PackedBoard.
    template <class Board>
    void men(const Board& board) {
        for (const Player player : {mover_, ~mover_})
            for (int kind = 0; kind < piece_kinds; ++kind)
                set(board.pieces(player, static_cast<Piece>(kind)));
    }
    // Four full planes: the mover to the king's side and to the queen's, the opponent likewise.
    void castling(const Position& position) {
        for (const Player player : {mover_, ~mover_})
            for (const bool king_side : {true, false})
                full(position.castling_rook(player, king_side) ? 1.0f : 0.0f);
    }
    void skip(int planes) { planes_ = planes_.subspan(static_cast<std::size_t>(planes) * 64); }

   private:
    std::span<float> planes_;
    Player mover_;
};

}  // namespace chess
