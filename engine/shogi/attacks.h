// Where pieces of each kind can go from a square, by tables made at compile time.
//
// Ranks and diagonals slide by subtraction in both directions (o - 2r, "hyperbola quintessence"
// on 81 bits: no two squares of such a line share a byte, so swapping bytes turns the line
// round); files by a table of 9 squares x 128 occupancies of the inner squares.
#pragma once

#include <array>

#include "engine/shogi/bitboard.h"
#include "engine/shogi/piece.h"

namespace shogi {

// Directions in pairs of opposites: d ^ 1 is the other way. 0 is towards rank a.
struct Direction {
    int file, rank;
};
inline constexpr std::array<Direction, 8> directions{
    {{0, -1}, {0, 1}, {1, 0}, {-1, 0}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};
inline constexpr int up = 0, down = 1;

namespace tables {

using PerSquare = std::array<Bitboard, square_count>;

constexpr Bitboard ray(int square, Direction direction) {
    Bitboard set = 0;
    int file = file_of(square) + direction.file, rank = rank_of(square) + direction.rank;
    for (; on_board(file, rank); file += direction.file, rank += direction.rank)
        set |= bit(square_at(file, rank));
    return set;
}

constexpr std::array<PerSquare, 8> make_rays() {
    std::array<PerSquare, 8> rays{};
    for (std::size_t d = 0; d < 8; ++d)
        for (int square = 0; square < square_count; ++square)
            rays[d][static_cast<std::size_t>(square)] = ray(square, directions[d]);
    return rays;
}
inline constexpr auto rays = make_rays();

// Squares one step away in the given directions (a bit mask over `directions`).
constexpr PerSquare make_steps(unsigned mask) {
    PerSquare steps{};
    for (int square = 0; square < square_count; ++square)
        for (std::size_t d = 0; d < 8; ++d) {
            const int file = file_of(square) + directions[d].file;
            const int rank = rank_of(square) + directions[d].rank;
            if ((mask >> d & 1) != 0 && on_board(file, rank))
                steps[static_cast<std::size_t>(square)] |= bit(square_at(file, rank));
        }
    return steps;
}

constexpr PerSquare make_knight(int forward) {
    PerSquare jumps{};
    for (int square = 0; square < square_count; ++square)
        for (const int side : {-1, 1}) {
            const int file = file_of(square) + side, rank = rank_of(square) + 2 * forward;
            if (on_board(file, rank))
                jumps[static_cast<std::size_t>(square)] |= bit(square_at(file, rank));
        }
    return jumps;
}

inline constexpr auto king = make_steps(0b11111111);
inline constexpr std::array<PerSquare, 2> pawn{make_steps(0b00000001), make_steps(0b00000010)};
inline constexpr std::array<PerSquare, 2> knight{make_knight(-1), make_knight(1)};
inline constexpr std::array<PerSquare, 2> silver{make_steps(0b11110001), make_steps(0b11110010)};
inline constexpr std::array<PerSquare, 2> gold{make_steps(0b01101111), make_steps(0b10011111)};
// One step along files and ranks, and one along diagonals.
inline constexpr auto cross = make_steps(0b00001111);
inline constexpr auto diagonal = make_steps(0b11110000);

constexpr std::uint16_t slide_in_file(int rank, int inner) {
    const int occupied = inner << 1;
    int reached = 0;
    for (const int step : {-1, 1})
        for (int at = rank + step; at >= 0 && at < board_size; at += step) {
            reached |= 1 << at;
            if ((occupied >> at & 1) != 0) break;
        }
    return static_cast<std::uint16_t>(reached);
}

constexpr std::array<std::array<std::uint16_t, 128>, 9> make_file_slides() {
    std::array<std::array<std::uint16_t, 128>, 9> slides{};
    for (std::size_t rank = 0; rank < 9; ++rank)
        for (std::size_t inner = 0; inner < 128; ++inner)
            slides[rank][inner] = slide_in_file(static_cast<int>(rank), static_cast<int>(inner));
    return slides;
}
inline constexpr auto file_slides = make_file_slides();

// Both directions of a line together.
constexpr PerSquare make_line(std::size_t direction) {
    PerSquare line{};
    for (std::size_t square = 0; square < square_count; ++square)
        line[square] = rays[direction][square] | rays[direction ^ 1][square];
    return line;
}
inline constexpr PerSquare rank_line = make_line(2), falling_line = make_line(4),
                           rising_line = make_line(6);

}  // namespace tables

constexpr Bitboard ray(int direction, int square) {
    return tables::rays[static_cast<std::size_t>(direction)][static_cast<std::size_t>(square)];
}

constexpr Bitboard swap_bytes(Bitboard set) {
    return Bitboard{__builtin_bswap64(low(set))} << 64 | __builtin_bswap64(high(set));
}

constexpr Bitboard slide_on(Bitboard line, int square, Bitboard occupied) {
    const Bitboard on_line = occupied & line;
    const Bitboard forward = on_line - bit(square);
    const Bitboard backward = swap_bytes(swap_bytes(on_line) - swap_bytes(bit(square)));
    return (forward ^ backward) & line;
}

constexpr Bitboard file_attacks(int square, Bitboard occupied) {
    const int base = file_of(square) * board_size;
    const auto inner = static_cast<std::size_t>(low(occupied >> (base + 1)) & 127);
    return Bitboard{tables::file_slides[static_cast<std::size_t>(square - base)][inner]} << base;
}

constexpr Bitboard rook_attacks(int square, Bitboard occupied) {
    return file_attacks(square, occupied) |
           slide_on(tables::rank_line[static_cast<std::size_t>(square)], square, occupied);
}

constexpr Bitboard bishop_attacks(int square, Bitboard occupied) {
    const auto at = static_cast<std::size_t>(square);
    return slide_on(tables::falling_line[at], square, occupied) |
           slide_on(tables::rising_line[at], square, occupied);
}

template <Player player>
constexpr Bitboard lance_attacks(int square, Bitboard occupied) {
    return file_attacks(square, occupied) & ray(player == Player::first ? up : down, square);
}

constexpr Bitboard king_attacks(int square) {
    return tables::king[static_cast<std::size_t>(square)];
}
constexpr Bitboard horse_attacks(int square, Bitboard occupied) {
    return bishop_attacks(square, occupied) | tables::cross[static_cast<std::size_t>(square)];
}
constexpr Bitboard dragon_attacks(int square, Bitboard occupied) {
    return rook_attacks(square, occupied) | tables::diagonal[static_cast<std::size_t>(square)];
}
template <Player player>
constexpr Bitboard pawn_attacks(int square) {
    return tables::pawn[index(player)][static_cast<std::size_t>(square)];
}
template <Player player>
constexpr Bitboard knight_attacks(int square) {
    return tables::knight[index(player)][static_cast<std::size_t>(square)];
}
template <Player player>
constexpr Bitboard silver_attacks(int square) {
    return tables::silver[index(player)][static_cast<std::size_t>(square)];
}
template <Player player>
constexpr Bitboard gold_attacks(int square) {
    return tables::gold[index(player)][static_cast<std::size_t>(square)];
}

}  // namespace shogi
