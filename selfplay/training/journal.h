// What a run tells of itself as it goes: a line of JSON for every network that it published, in
// DIR/metrics.jsonl, from which curves and progress lines are made. One owner, one thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "nn/training/learner.h"
#include "selfplay/records/game.h"

namespace selfplay::training {

// How well a network tells what it is asked, on average over positions; 0 where it is not asked.
struct Quality {
    double samples = 0;
    double loss = 0;  // weighted sum of all terms
    double policy_loss = 0, policy_accuracy = 0;
    double value_loss = 0, value_error = 0;  // error: square, of win less loss
    double ownership_loss = 0, score_loss = 0;
};

// Sums reports of a learner over many batches.
class QualityTally {
   public:
    void add(const nn::training::Report& report, std::span<const nn::training::Term> terms,
             int samples);
    Quality mean() const;

   private:
    std::vector<nn::training::Term> terms_;
    std::vector<nn::training::Cost> costs_;
    double samples_ = 0, loss_ = 0;
};

// What finished games were like.
struct GameTally {
    std::uint64_t games = 0, plies = 0, taught = 0, draws = 0, first_wins = 0, resigned = 0,
                  cut_off = 0;

    void add(const records::Game& game);
};

struct Entry {
    double seconds = 0;  // that the run has lasted, pauses between its parts left out
    std::uint64_t games = 0, positions = 0;  // in all; positions that teach
    std::int64_t steps = 0;
    Quality learned, held_out;
    // Since the entry before.
    GameTally played;
    double games_per_hour = 0, evaluations_per_second = 0, learner_share = 0, ratio = 0;
    std::uint64_t window = 0;  // games
    int simulations = 0;
    double resign_threshold = -1;
};

std::string to_json(const Entry& entry);

class Journal {
   public:
    // Reads what is there; a torn last line is cut off. Fails with engine::Error on a file that
    // cannot be read.
    explicit Journal(std::filesystem::path path);

    void append(const Entry& entry);
    const std::vector<Entry>& entries() const { return entries_; }

   private:
    std::filesystem::path path_;
    std::vector<Entry> entries_;
};

}  // namespace selfplay::training
