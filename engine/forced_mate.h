// Mates so near that a short look decides them: by checks alone, within three plies.
//
// For games in which a player in check without a legal move is mated. Their positions, which know
// nothing of the moves before, have play(move) and in_check(), and as members or beside them
// legal_moves(), has_legal_move() and checks(), the legal moves that give check.
#pragma once

#include <optional>

#include "engine/game.h"

namespace engine {

// What a few moves force, as the mover sees it: mating, by `move` first, or being mated.
struct ForcedMate {
    bool mates = false;
    int plies = 0;  // to the end, odd where the mover mates
    Move move;
};

template <class Position>
MoveList moves_of(const Position& position) {
    if constexpr (requires { position.legal_moves(); })
        return position.legal_moves();
    else
        return legal_moves(position);
}

template <class Position>
Position after(const Position& position, Move move) {
    Position next = position;
    next.play(move);
    return next;
}

template <class Position>
MoveList checks_of(const Position& position) {
    if constexpr (requires { position.checks(); })
        return position.checks();
    else
        return checks(position);
}

template <class Position>
bool any_move(const Position& position) {
    if constexpr (requires { position.has_legal_move(); })
        return position.has_legal_move();
    else
        return has_legal_move(position);
}

template <class Position>
std::optional<Move> mate_in_one(const Position& position, const MoveList& checks) {
    for (const Move move : checks)
        if (!any_move(after(position, move))) return move;
    return std::nullopt;
}

// Whether every answer to a check, of which there is one at least, lets the other side mate.
template <class Position>
bool all_answers_are_mated(const Position& position) {
    const auto answers = moves_of(position);
    for (const Move answer : answers) {
        const auto next = after(position, answer);
        if (!mate_in_one(next, checks_of(next))) return false;
    }
    return !answers.empty();
}

// The mover mates in one or three plies, or is in check and mated two plies from here whatever it
// answers. What the moves before may mean for it (a repetition on the way) is not seen.
template <class Position>
std::optional<ForcedMate> find_forced_mate(const Position& position) {
    const auto checks = checks_of(position);
    if (const auto move = mate_in_one(position, checks)) return ForcedMate{true, 1, *move};
    for (const Move move : checks)
        if (all_answers_are_mated(after(position, move))) return ForcedMate{true, 3, move};
    if (position.in_check() && all_answers_are_mated(position)) return ForcedMate{false, 2, {}};
    return std::nullopt;
}

}  // namespace engine
