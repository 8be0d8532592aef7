// Chess and Chess960 (Fischer random): one game in progress, as engine::Game asks.
//
// White is Player::first. A game ends by checkmate, stalemate, the third occurrence of a position,
// 50 moves by each side without capture or pawn's move, or material that cannot mate; it may be
// played on after a draw, as records are, until mate or stalemate. What chess looks like without
// its past is chess::Position; this class adds the keys for repetition and the last 8 boards for
// networks.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/chess/position.h"
#include "engine/encoding.h"
#include "engine/forced_mate.h"
#include "engine/game.h"

namespace chess {

using engine::Outcome;

// Why a game is over.
enum class Ending : std::uint8_t {
    none,
    checkmate,
    stalemate,
    threefold_repetition,
    fifty_moves,
    insufficient_material,
    fivefold_repetition,
    seventy_five_moves,
};

// The men of a board in 32 bytes: bits of Piece + 1 over three sets, and White's.
class PackedBoard {
   public:
    PackedBoard() = default;
    explicit PackedBoard(const Position& position);
    bool operator==(const PackedBoard&) const = default;
    Bitboard pieces(Player player, Piece piece) const;
    // `key` and all of the board.
    std::uint64_t mixed_into(std::uint64_t key) const {
        for (const Bitboard bits : bits_) key = engine::mixed(key, bits);
        return engine::mixed(key, white_);
    }

   private:
    std::array<Bitboard, 3> bits_{};
    Bitboard white_ = 0;
};

class Rollouts;   // chess/rollouts.h
class Exchanges;  // chess/exchanges.h

class Chess {
   public:
    using Rollouts = chess::Rollouts;
    using Exchanges = chess::Exchanges;
    static constexpr std::string_view name = "chess";
    // Boards that are remembered, the present one among them.
    static constexpr int remembered_boards = 8;

    Chess() = default;
    explicit Chess(const Position& position);

    // The past counts: equal games have the same positions behind them since the last capture or
    // pawn's move, and the same boards remembered.
    bool operator==(const Chess&) const = default;

    Player to_play() const { return position_.to_play(); }
    const Position& position() const { return position_; }

    Outcome outcome() const;
    // By the rules that end a game as soon as a player claims it, as engines play.
    Ending ending() const;
    // Only what ends a game without a claim: mate, stalemate, dead material, the fifth occurrence
    // of a position, 75 moves.
    Ending forced_ending() const;
    // Earlier occurrences of this position since the last capture or pawn's move.
    int repetitions() const { return repetitions_; }

    MoveList legal_moves() const { return position_.legal_moves(); }
    // A mate by checks within three plies, if the 50 moves leave room for it.
    std::optional<engine::ForcedMate> forced_mate() const;
    std::uint64_t key() const { return position_.key(); }
    void play(Move move);

    // The board `ago` plies back, 0 the present one, and how often it had occurred before then;
    // empty where the game is younger.
    struct PastBoard {
        PackedBoard board;
        int repetitions = 0;
    };
    std::optional<PastBoard> board_before(int ago) const;

    // Whether castling is written as the king taking its rook (e1h1) rather than by the king's
    // goal (e1g1). Set by a position that ordinary chess cannot write, and by UCI_Chess960.
    bool chess960() const { return chess960_; }
    void set_chess960(bool chess960) { chess960_ = chess960; }

    // FEN, X-FEN or Shredder-FEN; "startpos" is the start. See chess/fen.h.
    static Chess from_text(std::string_view text);
    std::string to_text() const;
    // UCI moves; both ways of castling are understood. For SAN see chess/san.h.
    std::optional<Move> move_from_text(std::string_view text) const;
    std::string move_to_text(Move move) const;

    // What networks see: chess/encoding.h.
    static std::span<const engine::Encoding<Chess>> encodings();

    // Perft, faster than through the interface of Game.
    std::uint64_t perft(int depth) const { return position_.perft(depth); }

   private:
    Position position_;
    std::vector<std::uint64_t> keys_;  // before this position, since the last irreversible move
    std::array<PackedBoard, remembered_boards - 1> past_{};  // a ring, by ply
    std::array<std::uint8_t, remembered_boards - 1> past_repetitions_{};
    std::uint8_t remembered_ = 0;
    bool chess960_ = false;
    int repetitions_ = 0;
};

std::string_view text(Ending ending);  // "checkmate", "50 moves" …

}  // namespace chess
