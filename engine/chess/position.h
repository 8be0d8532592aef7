// One chess position without its past: what perft, rollouts and the mate search copy and play on.
//
// Castling is written as the king taking its own rook, so that Chess960 needs no rule of its own.
// A Position is about 170 bytes, is copied rather than undone, and always holds exactly one king a
// side, no pawn on the last ranks, at most 16 pieces a side, and a mover who is able to answer: the
// player who just moved is not in check.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "engine/chess/bitboard.h"
#include "engine/game.h"

namespace chess {

using engine::Move;
using engine::MoveList;
using engine::Player;

enum class Piece : std::uint8_t { pawn, knight, bishop, rook, queen, king };
inline constexpr int piece_kinds = 6;
constexpr std::size_t index(Piece piece) { return static_cast<std::size_t>(piece); }

// How a 16-bit move code is read: from, to, kind, and what a pawn becomes.
enum class MoveKind : std::uint8_t { normal, promotion, en_passant, castling };

constexpr Move make_move(Square from, Square to, MoveKind kind = MoveKind::normal,
                         Piece promoted = Piece::knight) {
    return {static_cast<std::uint16_t>(from | to << 6 | static_cast<int>(kind) << 12 |
                                       (static_cast<int>(promoted) - 1) << 14)};
}
constexpr Square from_of(Move move) { return move.code & 63; }
constexpr Square to_of(Move move) { return move.code >> 6 & 63; }
constexpr MoveKind kind_of(Move move) { return static_cast<MoveKind>(move.code >> 12 & 3); }
// Meaningful for promotions only.
constexpr Piece promoted_of(Move move) { return static_cast<Piece>((move.code >> 14) + 1); }

// A position as a FEN or a diagram gives it, not yet checked.
struct Setup {
    struct Man {
        Player player;
        Piece piece;
    };
    std::array<std::optional<Man>, 64> board{};
    Player to_play = Player::first;
    Bitboard castling_rooks = 0;
    Square en_passant = no_square;
    int halfmove_clock = 0;
    int ply = 0;
};

class Position {
   public:
    // The start of an ordinary game.
    Position();
    // Fails with engine::Error that says why when the position cannot be played on. An en passant
    // square where no pawn may capture is dropped.
    explicit Position(const Setup& setup);

    bool operator==(const Position&) const = default;

    Player to_play() const { return to_play_; }
    Bitboard pieces(Piece piece) const { return kinds_[index(piece)]; }
    Bitboard pieces(Player player) const { return players_[index(player)]; }
    Bitboard pieces(Player player, Piece piece) const { return pieces(player) & pieces(piece); }
    Bitboard occupied() const { return players_[0] | players_[1]; }
    bool has(Square square) const { return board_[index(square)] != nothing; }
    // The square must not be empty.
    Piece piece_at(Square square) const { return static_cast<Piece>(board_[index(square)]); }
    Player player_at(Square square) const {
        return pieces(Player::first) & bit(square) ? Player::first : Player::second;
    }
    Square king(Player player) const { return first_square(pieces(player, Piece::king)); }

    // The rooks that may still castle.
    Bitboard castling_rooks() const { return castling_rooks_; }
    // The one of `player` that castles to the king's side (towards the h-file) or the queen's side.
    std::optional<Square> castling_rook(Player player, bool king_side) const;
    // Set only when some pawn may capture there.
    std::optional<Square> en_passant() const;
    // Plies since a capture or a pawn's move.
    int halfmove_clock() const { return halfmove_clock_; }
    // Plies since move 1 of White.
    int ply() const { return static_cast<int>(ply_); }
    // Of all but the counters.
    std::uint64_t key() const { return key_; }

    bool in_check() const { return checkers() != 0; }
    // Enemy pieces that attack the mover's king.
    Bitboard checkers() const;
    // Pieces of `by` that attack `square` when the squares of `occupied` are taken.
    Bitboard attackers(Player by, Square square, Bitboard occupied) const;

    // Whether the mover's pawn on `from`, which attacks `to` = en_passant(), may capture there.
    bool en_passant_legal(Square from, Square to) const;

    // All of them are legal; the order is fixed.
    MoveList legal_moves() const;
    // Those of them that capture or promote to a queen.
    MoveList captures() const;
    // Those of them that give check.
    MoveList checks() const;
    int count_legal_moves() const;
    bool has_legal_move() const;
    // Leaves of the tree of legal moves of that depth; 1 at depth 0.
    std::uint64_t perft(int depth) const;

    // `move` must be legal.
    void play(Move move);

    // Neither side could mate by any play whatever: bare kings, one knight, or bishops on squares
    // of one colour.
    bool insufficient_material() const;

   private:
    static constexpr std::uint8_t nothing = piece_kinds;

    void put(Player player, Piece piece, Square square);
    void remove(Player player, Piece piece, Square square);
    void shift_piece(Player player, Piece piece, Square from, Square to);
    void lose_castling(Bitboard rooks);
    template <Player us>
    void play_as(Move move);
    template <Player us>
    void finish_pawn_move(Move move);
    template <Player us>
    void castle(Square king_from, Square rook_from);
    void offer_en_passant(Square square);
    void check_setup(const Setup& setup) const;
    void check_castling() const;

    std::array<Bitboard, piece_kinds> kinds_{};
    std::array<Bitboard, 2> players_{};
    std::array<std::uint8_t, 64> board_{};
    std::uint64_t key_ = 0;
    Bitboard castling_rooks_ = 0;
    std::uint32_t ply_ = 0;
    std::uint16_t halfmove_clock_ = 0;
    std::uint8_t en_passant_ = no_square;
    Player to_play_ = Player::first;
};

}  // namespace chess
