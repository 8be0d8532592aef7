// Lessons side by side, as the learner wants them. It owns the numbers; one owner, one thread.
#pragma once

#include <span>
#include <vector>

#include "nn/training/learner.h"
#include "selfplay/training/lesson.h"

namespace selfplay::training {

class Batch {
   public:
    // Overwrites what was there. `terms` are the learner's; all lessons have one shape. Outputs
    // that a lesson has no target for are not taught by it.
    void fill(std::span<const Lesson> lessons, int board,
              std::span<const nn::training::Term> terms);
    // Shows the numbers until the next fill; the second input only where the encoding has one.
    const nn::training::Samples& samples() const { return samples_; }

   private:
    struct Rows {
        std::vector<float> numbers, weights;
        std::vector<int> starts, moves;
    };

    static void add(const Lesson& lesson, nn::training::Loss loss, Rows& rows);

    std::vector<float> planes_, globals_;
    std::vector<Rows> rows_;
    nn::training::Samples samples_;
};

}  // namespace selfplay::training
