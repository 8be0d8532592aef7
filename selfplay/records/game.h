// A self-play game in memory: moves, what the searches said of them, and how it ended. Positions
// are not kept; whoever wants one plays the moves again. A value, written and read by anyone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/game.h"

namespace selfplay::records {

// What a policy target gives one move: share / 65535 of the whole.
struct Share {
    engine::Move move;
    std::uint16_t share = 0;
    bool operator==(const Share&) const = default;
};

struct Turn {
    engine::Move move;
    float value = 0;  // of the root after the search, in [-1, 1] as the player to move sees it
    float draws = 0;  // how likely a draw was to that search
    std::uint32_t simulations = 0;                   // of that search
    std::uint32_t first_share = 0, share_count = 0;  // in Game::shares; none: no policy target
    bool operator==(const Turn&) const = default;
};

enum class Ending : std::uint8_t { rules, resigned, move_limit, agreed };
std::string_view name_of(Ending ending);

struct Game {
    std::string game;         // "go" …
    std::string start;        // the first position, as the game writes it
    std::uint64_t steps = 0;  // of training that the network had
    // Whether there was no network, and rollouts judged the positions: then the value after a
    // search says more of a position than how a game by such players ended.
    bool by_rollouts = false;
    Ending ending = Ending::rules;
    engine::Outcome outcome = engine::Outcome::draw;
    float lead = 0;  // final, of the first player, in points
    // A point's owner at the end: +1 the first player, -1 the second, 0 nobody; empty in games
    // without territory.
    std::vector<std::int8_t> owners;
    std::vector<Turn> turns;
    std::vector<Share> shares;

    bool operator==(const Game&) const = default;

    std::span<const Share> policy(const Turn& turn) const {
        return std::span(shares).subspan(turn.first_share, turn.share_count);
    }
    // Appends a turn. `policy` sums to about 1 and is rounded to shares; moves that round to
    // nothing are left out. Empty: no policy target.
    void add(engine::Move move, float value, std::uint32_t simulations,
             std::span<const engine::Move> moves, std::span<const float> policy);
};

// As game.proto describes.
std::string to_bytes(const Game& game);
// Fails with engine::Error on bytes that are no such game or whose lists do not fit each other.
// Whether the moves are legal is for whoever plays them.
Game from_bytes(std::string_view bytes);

// What a person wants to know of it, several lines.
std::string describe(const Game& game);

}  // namespace selfplay::records
