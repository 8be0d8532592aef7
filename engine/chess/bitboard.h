// Squares, sets of squares, and where pieces attack: the ground under chess::Position.
//
// Square 0 is a1, 7 is h1, 63 is h8; bit n of a Bitboard is square n. The slider tables are built
// before main() in under 5 ms and constant from then on; objects of static storage duration must
// not ask for them. All else is computed by the compiler.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "engine/game.h"

namespace chess {

using Bitboard = std::uint64_t;
using Square = int;

inline constexpr Square no_square = 64;

constexpr int file_of(Square square) { return square & 7; }
constexpr int rank_of(Square square) { return square >> 3; }
constexpr Square square_at(int file, int rank) { return rank * 8 + file; }
constexpr Bitboard bit(Square square) { return Bitboard{1} << square; }
constexpr Square first_square(Bitboard set) { return std::countr_zero(set); }
constexpr Square last_square(Bitboard set) { return 63 - std::countl_zero(set); }
constexpr bool more_than_one(Bitboard set) { return (set & (set - 1)) != 0; }
constexpr std::size_t index(Square square) { return static_cast<std::size_t>(square); }
constexpr std::size_t index(engine::Player player) { return static_cast<std::size_t>(player); }

// Removes the lowest square and returns it; `set` must not be empty.
constexpr Square pop(Bitboard& set) {
    const Square square = first_square(set);
    set &= set - 1;
    return square;
}

inline constexpr Bitboard file_a = 0x0101010101010101, file_h = file_a << 7;
inline constexpr Bitboard rank_1 = 0xff;
inline constexpr Bitboard dark_squares = 0xaa55aa55aa55aa55;  // a1 among them

constexpr Bitboard rank_mask(int rank) { return rank_1 << (8 * rank); }
// Rank 0 is the player's own back rank.
constexpr Bitboard rank_mask(engine::Player player, int rank) {
    return rank_mask(player == engine::Player::first ? rank : 7 - rank);
}

// The set moved by one step: `up` ranks as the player sees the board, `right` files as White does.
template <engine::Player player, int up, int right>
constexpr Bitboard shift(Bitboard set) {
    if constexpr (right > 0) set &= ~file_h;
    if constexpr (right < 0) set &= ~file_a;
    constexpr int by = (player == engine::Player::first ? 8 : -8) * up + right;
    return by > 0 ? set << (by > 0 ? by : 0) : set >> (by > 0 ? 0 : -by);
}

template <engine::Player player>
constexpr Bitboard pawn_attacks(Bitboard pawns) {
    return shift<player, 1, 1>(pawns) | shift<player, 1, -1>(pawns);
}

namespace tables {

template <std::size_t count>
constexpr std::array<Bitboard, 64> leaps(const std::array<std::array<int, 2>, count>& steps) {
    std::array<Bitboard, 64> result{};
    for (Square square = 0; square < 64; ++square)
        for (const auto& step : steps) {
            const int file = file_of(square) + step[0], rank = rank_of(square) + step[1];
            if (file >= 0 && file < 8 && rank >= 0 && rank < 8)
                result[index(square)] |= bit(square_at(file, rank));
        }
    return result;
}

inline constexpr auto knight =
    leaps<8>({{{1, 2}, {2, 1}, {2, -1}, {1, -2}, {-1, -2}, {-2, -1}, {-2, 1}, {-1, 2}}});
inline constexpr auto king =
    leaps<8>({{{0, 1}, {1, 1}, {1, 0}, {1, -1}, {0, -1}, {-1, -1}, {-1, 0}, {-1, 1}}});
inline constexpr std::array<std::array<Bitboard, 64>, 2> pawn = {leaps<2>({{{-1, 1}, {1, 1}}}),
                                                                 leaps<2>({{{-1, -1}, {1, -1}}})};

// "Fancy magic bitboards" (Kannan 2007): the squares of `mask` that are occupied, multiplied by
// `number`, give in their top bits an index into the attacks of one square.
struct Magic {
    Bitboard mask = 0, number = 0;
    const Bitboard* attacks = nullptr;
    int shift = 0;

    Bitboard operator()(Bitboard occupied) const {
        return attacks[((occupied & mask) * number) >> shift];
    }
};

class Sliders {
   public:
    Sliders();
    Sliders(const Sliders&) = delete;
    Sliders& operator=(const Sliders&) = delete;

    std::array<Magic, 64> bishop, rook;
    // Squares strictly between two on one line, else none.
    std::array<std::array<Bitboard, 64>, 64> between{};
    // The whole line through two squares, edge to edge, else none.
    std::array<std::array<Bitboard, 64>, 64> line{};

   private:
    std::array<Bitboard, 107648> attacks_{};
};

extern const Sliders sliders;

}  // namespace tables

inline Bitboard knight_attacks(Square square) { return tables::knight[index(square)]; }
inline Bitboard king_attacks(Square square) { return tables::king[index(square)]; }
// Where a pawn of `player` on `square` captures.
inline Bitboard pawn_attacks(engine::Player player, Square square) {
    return tables::pawn[index(player)][index(square)];
}
inline Bitboard bishop_attacks(Square square, Bitboard occupied) {
    return tables::sliders.bishop[index(square)](occupied);
}
inline Bitboard rook_attacks(Square square, Bitboard occupied) {
    return tables::sliders.rook[index(square)](occupied);
}
inline Bitboard queen_attacks(Square square, Bitboard occupied) {
    return bishop_attacks(square, occupied) | rook_attacks(square, occupied);
}
inline Bitboard between(Square a, Square b) { return tables::sliders.between[index(a)][index(b)]; }
inline Bitboard line(Square a, Square b) { return tables::sliders.line[index(a)][index(b)]; }

}  // namespace chess
