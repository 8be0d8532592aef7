// What a network learns from one position of a recorded game: the planes as its encoding writes
// them, made again by playing the moves, and a target for every output, all as the player to move
// sees it. Pure functions of the record, for any thread.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "engine/encoding.h"
#include "search/answer.h"
#include "selfplay/records/game.h"

namespace selfplay::training {

struct Lesson {
    std::vector<float> planes, globals;
    std::vector<int> moves;     // the legal ones, as places in the network's policy
    std::vector<float> policy;  // per move, summing to 1; all 0 where the search was not to teach
    float policy_weight = 1;    // of the policy in the loss; negative: what not to do
    std::array<float, 3> outcome{};  // of win, draw, loss
    float value = 0;                 // win less loss
    // Whether the game was played to its end and counted; else the two below say nothing.
    bool scored = false;
    std::vector<float> ownership;  // per point 1 the mover's, -1 the opponent's; empty off Go
    float lead = 0;                // final, in points
    float moves_left = 0;          // in plies
};

// What the value is taught.
struct ValueTarget {
    // Of it that is what the search expected of the position, the rest being how the game ended;
    // nothing of it where there was no search, as in games by others.
    float search_share = 0;
    // A game cut off at its limit is taken to end as its last search expected, and not in a draw;
    // what is counted at its end, as in Go, counts all the same.
    bool judges_cut_off = false;
};

// The position before turn `turn`; fails with engine::Error on a record that cannot be played.
template <engine::Encoded G>
G position_of(const records::Game& record, std::size_t turn) {
    G game = G::from_text(record.start);
    for (std::size_t i = 0; i < turn; ++i) game.play(record.turns[i].move);
    return game;
}

namespace lesson {

// Where the turned board has what the encoding has at `index`.
inline std::size_t turned_place(std::size_t index, const engine::EncodingShape& shape,
                                int symmetry) {
    if (symmetry == 0 || index >= shape.points()) return index;
    // Symmetries 5 and 6 undo each other, the rest themselves.
    const int inverse = symmetry == 5 ? 6 : symmetry == 6 ? 5 : symmetry;
    return search::turned_point(index, static_cast<std::size_t>(shape.width), inverse);
}

template <engine::Encoded G>
void write_planes(const G& game, const engine::Encoding<G>& encoding,
                  const engine::EncodingShape& shape, int symmetry, Lesson& to) {
    to.planes.resize(shape.planes_size());
    to.globals.resize(static_cast<std::size_t>(shape.globals));
    encoding.write(game, to.planes, to.globals);
    if (symmetry == 0) return;
    std::vector<float> turned(to.planes.size());
    search::turn_planes(to.planes, static_cast<std::size_t>(shape.width), symmetry, turned);
    to.planes.swap(turned);
}

template <engine::Encoded G>
void write_policy(const G& game, const engine::Encoding<G>& encoding,
                  const engine::EncodingShape& shape, int symmetry,
                  std::span<const records::Share> shares, Lesson& to) {
    to.moves.clear();
    to.policy.clear();
    float sum = 0;
    for (const auto move : game.legal_moves()) {
        const auto place = static_cast<std::size_t>(encoding.policy_index(game, move));
        to.moves.push_back(static_cast<int>(turned_place(place, shape, symmetry)));
        float weight = 0;
        for (const auto& share : shares)
            if (share.move == move) weight = share.share;
        to.policy.push_back(weight);
        sum += weight;
    }
    for (auto& weight : to.policy) weight = sum > 0 ? weight / sum : 0;
}

// What the search before a turn expected of win, draw and loss.
inline std::array<float, 3> expected_outcome(const records::Turn& turn) {
    const float draw = std::min(turn.draws, 1 - std::abs(turn.value));
    return {(1 - draw + turn.value) / 2, draw, (1 - draw - turn.value) / 2};
}

// What its rollouts expected, of those that had a winner: random play hardly mates, and nine of ten
// games of chess say nothing. As if a few more had been decided, half of them for each side, so
// that one rollout among hundreds is no verdict.
inline std::array<float, 3> rolled_outcome(const records::Turn& turn) {
    constexpr float even = 0.05f;
    const float win = std::clamp(0.5f + turn.value / (1 - turn.draws + even) / 2, 0.0f, 1.0f);
    return {win, 0, 1 - win};
}

// How the game ended, as the player sees it who is to move before turn `turn`.
inline std::array<float, 3> final_outcome(const records::Game& record, std::size_t turn,
                                          engine::Player mover, const ValueTarget& target) {
    const bool cut_off = record.ending == records::Ending::move_limit && record.owners.empty();
    if (target.judges_cut_off && cut_off) {
        auto outcome = expected_outcome(record.turns.back());
        if ((record.turns.size() - 1 - turn) % 2 != 0) std::swap(outcome[0], outcome[2]);
        return outcome;
    }
    const float result = engine::value_for(mover, record.outcome);
    return {result > 0 ? 1.0f : 0.0f, result == 0 ? 1.0f : 0.0f, result < 0 ? 1.0f : 0.0f};
}

// In games by rollouts what these expected of the position is all.
inline void write_outcome(const records::Game& record, std::size_t turn, engine::Player mover,
                          const ValueTarget& target, Lesson& to) {
    if (record.by_rollouts) {
        to.outcome = rolled_outcome(record.turns[turn]);
    } else {
        to.outcome = final_outcome(record, turn, mover, target);
        const float share = record.turns[turn].simulations > 0 ? target.search_share : 0;
        const auto expected = expected_outcome(record.turns[turn]);
        for (std::size_t i = 0; i < 3; ++i) to.outcome[i] += share * (expected[i] - to.outcome[i]);
    }
    to.value = to.outcome[0] - to.outcome[2];
}

template <engine::Encoded G>
void write_owners(const G& game, const engine::Encoding<G>& encoding,
                  const engine::EncodingShape& shape, int symmetry, const records::Game& record,
                  Lesson& to) {
    to.scored = !record.owners.empty();
    const float sign = game.to_play() == engine::Player::first ? 1.0f : -1.0f;
    to.lead = to.scored ? sign * record.lead : 0;
    if constexpr (requires { game.move_at({0, 0}); }) {
        to.ownership.assign(shape.points(), 0.0f);
        if (!to.scored) return;
        for (int y = 0; y < shape.height; ++y)
            for (int x = 0; x < shape.width; ++x) {
                const auto place = encoding.policy_index(game, game.move_at({x, y}));
                to.ownership[turned_place(static_cast<std::size_t>(place), shape, symmetry)] =
                    sign * static_cast<float>(
                               record.owners[static_cast<std::size_t>(y * shape.width + x)]);
            }
    }
}

}  // namespace lesson

// The lesson of turn `turn` on the board turned by `symmetry` (0 .. shape.symmetries - 1).
template <engine::Encoded G>
void write_lesson(const records::Game& record, std::size_t turn,
                  const engine::Encoding<G>& encoding, int symmetry, const ValueTarget& target,
                  Lesson& to) {
    const G game = position_of<G>(record, turn);
    const auto shape = encoding.shape(game);
    const auto& played = record.turns[turn];
    lesson::write_planes(game, encoding, shape, symmetry, to);
    lesson::write_policy(game, encoding, shape, symmetry, record.policy(played), to);
    lesson::write_outcome(record, turn, game.to_play(), target, to);
    lesson::write_owners(game, encoding, shape, symmetry, record, to);
    to.moves_left = static_cast<float>(record.turns.size() - turn);
}

}  // namespace selfplay::training
