// How strong a run has become: its networks, kept every so often, on one Elo scale with fixed
// opponents. A pair of games at a time is added, against whoever tells most, so that measuring
// costs the share of the time that it is allowed. Results are kept in DIR/ladder.jsonl. One owner,
// one thread.
#pragma once

#include <algorithm>
#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "selfplay/training/arena.h"
#include "selfplay/training/elo.h"
#include "selfplay/training/folder.h"

namespace selfplay::training {

// One player of the ladder.
struct Rung {
    std::string name;     // "step 12000", "UCT 1000"
    double seconds = -1;  // of the run when the network was kept; -1: a fixed opponent
    int games = 0;
    Strength strength;
    int timed_games = 0;       // of those that it was the opponent in,
    double timed_seconds = 0;  // which took so long in all
};

class Ladder {
   public:
    // Reads the results that are there. Fails with engine::Error when they cannot be read.
    Ladder(const RunFolder& folder, const Settings& settings, int threads);

    // Keeps a copy of the newest network as the one to be measured from now on.
    void keep(std::int64_t steps, double seconds);
    // Whether the newest one is so old that it is time for another, or there is none.
    bool wants_snapshot(double seconds) const;
    // Plays a pair of games for every two threads, if there is a network to measure, against an
    // opponent with whom that is not likely to take more than `most_seconds`, or the least one.
    void measure(const std::stop_token& stop, double most_seconds);

    // Fixed opponents first, then networks as they came.
    const std::vector<Rung>& rungs() const { return rungs_; }
    const Rung* newest() const;

   private:
    struct Fixed {
        std::string name;
        PlayerSettings player;
        Belief belief;
    };
    std::vector<Fixed> fixed_opponents() const;
    std::filesystem::path file_of(const std::string& name) const;
    PlayerSettings player_of(std::size_t rung) const;
    std::size_t rung_named(const std::string& name, double seconds);
    void read();
    void add(std::size_t a, std::size_t b, const Tally& tally, double seconds);
    void rate();
    int games_a_measure() const { return 2 * std::max(1, threads_ / 2); }
    double seconds_a_game(std::size_t opponent) const;
    std::size_t best_opponent(std::size_t rung, double most_seconds) const;
    int games_between(std::size_t a, std::size_t b) const;

    const RunFolder& folder_;
    Settings settings_;
    int threads_;
    std::vector<Fixed> fixed_;
    std::vector<Rung> rungs_;
    std::vector<Pairing> pairings_;
    std::uint64_t played_ = 0;
};

}  // namespace selfplay::training
