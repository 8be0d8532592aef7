// The network that learns in a run, with its checkpoints: it goes on from the newest sound one, and
// returns to it when a step yields what is no number. One owner, one thread; calls block.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "nn/training/learner.h"
#include "selfplay/training/folder.h"
#include "selfplay/training/journal.h"
#include "selfplay/training/learn_settings.h"

namespace selfplay::training {

// Told what happened, one line each.
using Say = std::function<void(const std::string&)>;

class Student {
   public:
    // `fresh` is what a new run begins with. Fails with engine::Error when there are checkpoints
    // and none fits.
    Student(nn::Graph fresh, const LearnSettings& settings, int threads, const RunFolder& folder,
            Say say);

    // Fails with engine::Error when learning cannot go on: it has come to no number thrice in a
    // row since a checkpoint was last written.
    void learn(const nn::training::Samples& samples);
    nn::training::Report judge(const nn::training::Samples& samples) {
        return learner_.evaluate(samples);
    }
    nn::Graph newest() const { return learner_.newest(); }
    // To play with: averaged weights, their batch norms measured on these samples.
    nn::Graph playable(const nn::training::Samples& samples) {
        return averages_ ? learner_.averaged_on(samples) : learner_.newest();
    }

    // Whatever fails, a sound checkpoint stays.
    void save();

    std::int64_t steps() const { return learner_.steps(); }
    const std::vector<nn::training::Term>& terms() const { return learner_.terms(); }
    // What was learned since the last call cost.
    Quality take_quality();

   private:
    void restore();
    void fall_back(const std::string& fault);

    const RunFolder& folder_;
    Say say_;
    nn::training::Learner learner_;
    bool averages_;
    QualityTally tally_;
    int faults_ = 0;
};

}  // namespace selfplay::training
