// What a network learns from one position of a recorded game: the planes as its encoding writes
// them, made again by playing the moves, and a target for every output, all as the player to move
// sees it. Pure functions of the record, for any thread.
#pragma once

#include <array>
#include <span>
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

// `search_share` of the target is the searched value of the position itself.
inline void write_outcome(const records::Game& record, const records::Turn& turn,
                          engine::Player mover, float search_share, Lesson& to) {
    const float result = engine::value_for(mover, record.outcome);
    const float won = 1 - search_share;
    const float hoped = search_share * (1 + turn.value) / 2;
    to.outcome = {hoped + (result > 0 ? won : 0), result == 0 ? won : 0,
                  search_share - hoped + (result < 0 ? won : 0)};
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
                  const engine::Encoding<G>& encoding, int symmetry, float search_share,
                  Lesson& to) {
    const G game = position_of<G>(record, turn);
    const auto shape = encoding.shape(game);
    const auto& played = record.turns[turn];
    lesson::write_planes(game, encoding, shape, symmetry, to);
    lesson::write_policy(game, encoding, shape, symmetry, record.policy(played), to);
    lesson::write_outcome(record, played, game.to_play(), search_share, to);
    lesson::write_owners(game, encoding, shape, symmetry, record, to);
    to.moves_left = static_cast<float>(record.turns.size() - turn);
}

}  // namespace selfplay::training
