// Matches that a run plays in its own process to judge its networks: the gate that new weights must
// pass, and pairs of games for the ladder. Every call blocks until its games are over.
#pragma once

#include <filesystem>
#include <stop_token>
#include <string>

#include "selfplay/match.h"
#include "selfplay/training/settings.h"

namespace selfplay::training {

// A network in a file, thinking so much a move.
PlayerSettings network_player(const std::filesystem::path& weights, int simulations,
                              const Settings& settings);
// Our search by games played out, without a network.
PlayerSettings rollout_player(int simulations);

// The game, board and komi that the run is about, counted as in self-play; every pair of games
// begins with its own few random moves. A game that a player cannot begin fails with engine::Error.
struct Duel {
    PlayerSettings first, second;
    int games = 2;
    int concurrency = 1;
    std::uint64_t seed = 1;  // of the openings
};
// As the first player sees it; of what was played until `stop`.
Tally play(const Settings& settings, const Duel& duel, const std::stop_token& stop);

// Whether `candidate` has beaten `champion` as the settings ask.
struct Verdict {
    Tally tally;
    bool passed = false;
};
Verdict judge(const Settings& settings, const std::filesystem::path& champion,
              const std::filesystem::path& candidate, int threads, const std::stop_token& stop);

}  // namespace selfplay::training
