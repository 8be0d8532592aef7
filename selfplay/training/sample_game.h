// A self-play game as a report shows it: every position as the game writes it, to be stepped
// through.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "engine/game.h"
#include "selfplay/records/game.h"

namespace selfplay::training {

struct SampleGame {
    std::vector<std::string> positions;  // one more than moves
    std::vector<std::string> moves;
    std::vector<float> values;  // of the searches, as the first player sees them
    std::string result;         // one line
};

// The record must be playable.
template <engine::Game G>
SampleGame sample_of(const records::Game& record) {
    SampleGame sample;
    G game = G::from_text(record.start);
    for (const auto& turn : record.turns) {
        const bool first = game.to_play() == engine::Player::first;
        sample.positions.push_back(game.to_text());
        sample.moves.push_back(game.move_to_text(turn.move));
        sample.values.push_back(first ? turn.value : -turn.value);
        game.play(turn.move);
    }
    sample.positions.push_back(game.to_text());
    const auto winner = record.outcome == engine::Outcome::first_wins    ? "the first player won"
                        : record.outcome == engine::Outcome::second_wins ? "the second player won"
                                                                         : "a draw";
    sample.result =
        fmt::format("{} ({}), network of step {}", winner, name_of(record.ending), record.steps);
    return sample;
}

}  // namespace selfplay::training
