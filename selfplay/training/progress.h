// Rates and counts between two looks, for progress lines and the journal. One owner, one thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "selfplay/training/actor.h"
#include "selfplay/training/folder.h"
#include "selfplay/training/journal.h"

namespace selfplay::training {

// When a run comes to its end by itself.
struct Bounds {
    std::optional<double> minutes;       // of this call
    std::optional<std::uint64_t> games;  // in all, those of earlier calls among them
};

// How far a run has come.
struct Standing {
    RunState state;
    std::uint64_t evaluations = 0;             // of the actors, in this call
    std::uint64_t samples = 0, positions = 0;  // learned from, and new ones, in this call
    double learn_seconds = 0;
    std::int64_t steps = 0;
};

class Progress {
   public:
    explicit Progress(const Bounds& bounds) : bounds_(bounds) {}

    void begin(const Standing& now) { first_ = told_ = entered_ = now; }
    void add(const records::Game& game) { played_.add(game); }

    // What a person wants to know, when it is time to tell it again.
    std::optional<std::string> due(const Standing& now);
    // Told from now on.
    void set_quality(const Quality& held_out) { held_out_ = held_out; }
    // The fields of a journal's entry that are known here; counting starts anew.
    Entry take_entry(const Standing& now);

   private:
    std::string time_left(const Standing& now) const;

    static constexpr double interval = 10;  // seconds

    Bounds bounds_;
    Standing first_, told_, entered_;
    GameTally played_;
    Quality held_out_;
};

}  // namespace selfplay::training
