#include "engine/shogi/exchanges.h"

#include "engine/quiescence.h"
#include "engine/shogi/movegen.h"

namespace shogi {

namespace {

// By kind, as Apery counts them; in hand as on the board, the king never.
constexpr std::array<int, kind_count> worth = {0, 90,  315, 405, 495, 540, 855, 990,
                                               0, 540, 540, 540, 540, 0,   945, 1395};
constexpr int worth_of(Kind kind) { return worth[index(kind)]; }

struct Trading {
    using Position = shogi::Position;

    static int material(const Position& position) {
        const Player us = position.to_play();
        int sum = 0;
        for (const Kind kind : board_kinds)
            sum += worth_of(kind) * (count(position.of(us, kind)) - count(position.of(~us, kind)));
        for (const Kind kind : hand_kinds)
            sum += worth_of(kind) * (position.hand(us, kind) - position.hand(~us, kind));
        return sum;
    }
    // A captured piece is lost to one side and won by the other.
    static int gain(const Position& position, Move move) {
        if (is_drop(move)) return 0;
        const Kind moved = position.at(from_square(move)).kind();
        const Piece victim = position.at(to_square(move));
        const int promotion = is_promotion(move) ? worth_of(promoted(moved)) - worth_of(moved) : 0;
        return victim.empty()
                   ? promotion
                   : promotion + worth_of(victim.kind()) + worth_of(unpromoted(victim.kind()));
    }
    // The most valuable victim first, by the least valuable attacker.
    static int rank(const Position& position, Move move) {
        if (is_drop(move)) return 0;
        return 16 * gain(position, move) - worth_of(position.at(from_square(move)).kind());
    }
    static engine::MoveList captures(const Position& position) { return shogi::captures(position); }
    static engine::MoveList legal_moves(const Position& position) {
        return shogi::legal_moves(position);
    }
    static bool in_check(const Position& position) { return position.in_check(); }
};

}  // namespace

int settled_material(const Position& position) {
    return engine::Quiescence<Trading>::search(position);
}

engine::RolloutResult Exchanges::play(const Shogi& from, engine::Random&) const {
    constexpr float scale = 1500;
    return engine::play_captures<Trading>(from, scale);
}

}  // namespace shogi
