// Games of Go between policies without search, many side by side: for the stages that learn from
// self-play. Scored as the board stands once nothing but eyes is left to fill.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "engine/go/go.h"
#include "nn/training/workers.h"
#include "search/policy_player.h"
#include "selfplay/records/game.h"

namespace selfplay::alphago {

struct Playing {
    go::Go game;
    records::Game record;  // outcome and score once it is over
    int number = 0;
    std::uint64_t seed = 0;
};

using Networks = std::vector<std::shared_ptr<const search::Network>>;
inline constexpr int uniform_policy = -1;

// How games go. Called from several threads.
struct Plan {
    // Which of the networks, or uniform_policy, makes the next move.
    std::function<int(const Playing&)> policy_of;
    // Whether the next move is one to learn from.
    std::function<bool(const Playing&)> teaches;
};

// `count` games on such a board from the usual komi, played to their ends by the workers, each with
// its share. Equal seeds give equal games, whatever the number of workers.
std::vector<Playing> play_games(int count, int size, std::uint64_t seed, const Networks& networks,
                                const Plan& plan, nn::training::Workers& workers);

// In [-1, 1], as `player` sees the game's end.
float result_for(const records::Game& record, engine::Player player);

// A network to play with: on a file, in the fastest of the exact precisions.
std::shared_ptr<const search::Network> playing_network(nn::Graph graph);

}  // namespace selfplay::alphago
