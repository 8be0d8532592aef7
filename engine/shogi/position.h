// A shogi position without its past: pieces, hands and the player to move. Small and flat, to be
// copied before every move; the rules that need the moves before are Shogi's (shogi.h).
//
// Nothing here checks a move: callers pass what legal_moves (movegen.h) gave.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "engine/shogi/attacks.h"
#include "engine/shogi/bitboard.h"
#include "engine/shogi/move.h"
#include "engine/shogi/piece.h"

namespace shogi {

class Position {
   public:
    // An empty board, Black to move.
    Position() = default;
    // The start of an even game.
    static Position start();

    bool operator==(const Position&) const = default;

    Player to_play() const { return to_play_; }
    Piece at(int square) const { return board_[static_cast<std::size_t>(square)]; }
    int hand(Player player, Kind kind) const { return hands_[index(player)][index(kind)]; }
    bool hand_empty(Player player) const {
        return std::bit_cast<std::uint64_t>(hands_[index(player)]) == 0;
    }

    Bitboard occupied() const { return by_player_[0] | by_player_[1]; }
    Bitboard of(Player player) const { return by_player_[index(player)]; }
    Bitboard of(Kind kind) const { return by_kind_[index(kind)]; }
    Bitboard of(Player player, Kind kind) const { return of(player) & of(kind); }
    // All kinds that move as a gold.
    Bitboard gold_movers() const {
        return of(Kind::gold) | of(Kind::tokin) | of(Kind::promoted_lance) |
               of(Kind::promoted_knight) | of(Kind::promoted_silver);
    }
    // False only for the attacker of a mate problem, and while a position is being set up.
    bool has_king(Player player) const { return of(player, Kind::king) != 0; }
    // The player must have one.
    int king(Player player) const { return first(of(player, Kind::king)); }

    // Zobrist key of board, hands and mover.
    std::uint64_t key() const;

    // Pieces of `player` that reach `square` when `occupied` blocks the way.
    Bitboard attackers(Player player, int square, Bitboard occupied) const;
    // The pieces giving check to the player to move.
    Bitboard checkers() const;
    bool in_check() const { return checkers() != 0; }

    void play(Move move);
    // For the perft and others that know the mover at compile time.
    template <Player us>
    void play_as(Move move);
    // Undoes the last move, which took `captured` off the board.
    void take_back(Move move, Piece captured);

    // Setting up; `square` must be empty.
    void put(int square, Piece piece);
    void remove(int square);
    void set_hand(Player player, Kind kind, int pieces) {
        hands_[index(player)][index(kind)] = static_cast<std::uint8_t>(pieces);
    }
    void set_to_play(Player player) { to_play_ = player; }

   private:
    template <Player us>
    void capture(int square);

    std::array<Bitboard, 2> by_player_{};
    std::array<Bitboard, kind_count> by_kind_{};
    std::uint64_t board_key_ = 0;
    std::array<std::array<std::uint8_t, 8>, 2> hands_{};
    std::array<Piece, square_count> board_{};
    Player to_play_ = Player::first;
};

// All squares that pieces of `player` reach when `occupied` blocks the way.
template <Player player>
Bitboard attacked_squares(const Position& position, Bitboard occupied);

}  // namespace shogi
