// Writes planes of a shogi board one behind the other, as the mover sees them: rows from the far
// side. A value of one owner; the planes must outlive it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "engine/shogi/position.h"

namespace shogi {

// Row by row from the far side of `mover`.
constexpr std::size_t cell(int square, Player mover) {
    const int seen = mover == Player::first ? square : turned(square);
    return static_cast<std::size_t>(rank_of(seen) * board_size + board_size - 1 - file_of(seen));
}

class PlaneWriter {
   public:
    PlaneWriter(std::span<float> out, Player mover) : planes_(out), mover_(mover) {
        std::fill(out.begin(), out.end(), 0.0f);
    }

    void squares(Bitboard set) {
        for_each(set, [this](int square) { planes_[cell(square, mover_)] = 1; });
        skip(1);
    }
    void constant(float value) {
        if (value != 0) std::fill_n(planes_.begin(), square_count, value);
        skip(1);
    }
    // 14 planes of the mover's pieces on the board and 14 of the opponent's.
    void board(const Position& position) {
        for (const Player player : {mover_, ~mover_})
            for (const Kind kind : board_kinds) squares(position.of(player, kind));
    }
    // 7 full planes of the mover's pieces in hand and 7 of the opponent's, as shares of a full set.
    void hands(const Position& position) {
        for (const Player player : {mover_, ~mover_})
            for (const Kind kind : hand_kinds)
                constant(static_cast<float>(position.hand(player, kind)) /
                         static_cast<float>(full_set[index(kind)]));
    }
    void skip(int number) {
        planes_ = planes_.subspan(static_cast<std::size_t>(number) * square_count);
    }

   private:
    std::span<float> planes_;
    const Player mover_;
};

}  // namespace shogi
