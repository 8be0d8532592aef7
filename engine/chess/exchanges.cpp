#include "engine/chess/exchanges.h"

#include "engine/quiescence.h"

namespace chess {

namespace {

// Centipawns, the king's never counted (Michniewski, "Simplified Evaluation Function").
constexpr std::array<int, piece_kinds> worth = {100, 320, 330, 500, 900, 0};
constexpr int worth_of(Piece piece) { return worth[index(piece)]; }

struct Trading {
    using Position = chess::Position;

    static int material(const Position& position) {
        int sum = 0;
        for (std::size_t kind = 0; kind < piece_kinds; ++kind) {
            const auto piece = static_cast<Piece>(kind);
            sum += worth[kind] * (std::popcount(position.pieces(position.to_play(), piece)) -
                                  std::popcount(position.pieces(~position.to_play(), piece)));
        }
        return sum;
    }
    static int gain(const Position& position, Move move) {
        switch (kind_of(move)) {
            case MoveKind::en_passant:
                return worth_of(Piece::pawn);
            case MoveKind::castling:
                return 0;
            case MoveKind::promotion:
                return captured(position, move) + worth_of(promoted_of(move)) -
                       worth_of(Piece::pawn);
            case MoveKind::normal:
                break;
        }
        return captured(position, move);
    }
    // The most valuable victim first, by the least valuable attacker.
    static int rank(const Position& position, Move move) {
        return 16 * gain(position, move) - worth_of(position.piece_at(from_of(move)));
    }
    static MoveList captures(const Position& position) { return position.captures(); }
    static MoveList legal_moves(const Position& position) { return position.legal_moves(); }
    static bool in_check(const Position& position) { return position.in_check(); }

   private:
    static int captured(const Position& position, Move move) {
        return position.has(to_of(move)) ? worth_of(position.piece_at(to_of(move))) : 0;
    }
};

}  // namespace

int settled_material(const Position& position) {
    return engine::Quiescence<Trading>::search(position);
}

engine::RolloutResult Exchanges::play(const Chess& from, engine::Random&) const {
    // With half of the value by a network it comes so the closest to what a strong engine says
    // (weights/training.md).
    constexpr float scale = 300;
    return engine::play_captures<Trading>(from, scale);
}

}  // namespace chess
