// Sets of the 81 squares of a shogi board, one bit a square, and what can be asked of them.
//
// A square is a number, file by file: (file - 1) * 9 + rank, rank a being 0; so 1a is 0, 1i is 8
// and 9i is 80. Black (sente, Player::first) moves towards rank a.
#pragma once

#include <bit>
#include <cstdint>

#include "engine/game.h"

namespace shogi {

using engine::Player;

__extension__ typedef unsigned __int128 Bitboard;

inline constexpr int board_size = 9, square_count = 81;

constexpr int square_at(int file, int rank) { return file * board_size + rank; }
constexpr int file_of(int square) { return square / board_size; }
constexpr int rank_of(int square) { return square % board_size; }
constexpr bool on_board(int file, int rank) {
    return file >= 0 && file < board_size && rank >= 0 && rank < board_size;
}
// The board turned by half a turn: White's view of a square.
constexpr int turned(int square) { return square_count - 1 - square; }

constexpr Bitboard bit(int square) { return Bitboard{1} << square; }
constexpr std::uint64_t low(Bitboard set) { return static_cast<std::uint64_t>(set); }
constexpr std::uint64_t high(Bitboard set) { return static_cast<std::uint64_t>(set >> 64); }
constexpr bool has(Bitboard set, int square) { return (set >> square & 1) != 0; }
constexpr int count(Bitboard set) { return std::popcount(low(set)) + std::popcount(high(set)); }
// The lowest square of a set that is not empty.
constexpr int first(Bitboard set) {
    return low(set) ? std::countr_zero(low(set)) : 64 + std::countr_zero(high(set));
}

template <class Act>
constexpr void for_each(Bitboard set, Act act) {
    for (auto word = low(set); word; word &= word - 1) act(std::countr_zero(word));
    for (auto word = high(set); word; word &= word - 1) act(64 + std::countr_zero(word));
}

inline constexpr Bitboard all_squares = (Bitboard{1} << square_count) - 1;

constexpr Bitboard rank_squares(int rank) {
    Bitboard set = 0;
    for (int file = 0; file < board_size; ++file) set |= bit(square_at(file, rank));
    return set;
}
inline constexpr Bitboard top_rank = rank_squares(0), bottom_rank = rank_squares(8);

// Ranks counted from `player`'s far side: 0 is the last one its pieces can reach.
constexpr Bitboard far_rank(Player player, int rank) {
    return rank_squares(player == Player::first ? rank : 8 - rank);
}
template <Player player>
inline constexpr Bitboard last_rank = far_rank(player, 0);
template <Player player>
inline constexpr Bitboard last_two_ranks = far_rank(player, 0) | far_rank(player, 1);
template <Player player>
inline constexpr Bitboard promotion_zone = far_rank(player, 0) | far_rank(player, 1) |
                                           far_rank(player, 2);

// One step towards rank a or rank i; what leaves the board is lost.
constexpr Bitboard step_up(Bitboard set) { return (set & ~top_rank) >> 1; }
constexpr Bitboard step_down(Bitboard set) { return (set & ~bottom_rank) << 1; }
template <Player player>
constexpr Bitboard step_forward(Bitboard set) {
    return player == Player::first ? step_up(set) : step_down(set);
}
// One step to both neighbouring files.
constexpr Bitboard step_sideways(Bitboard set) { return (set << 9 & all_squares) | set >> 9; }

// All squares of the files in which `set`, at most one square a file, has none.
constexpr Bitboard files_without(Bitboard set) {
    const Bitboard bottoms = (bottom_rank - set) & bottom_rank;
    return (bottoms << 1) - (bottoms >> 8);
}

}  // namespace shogi
