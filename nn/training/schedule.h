// How large a step is when: the learning rate over the steps of a run.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace nn::training {

struct Schedule {
    float rate = 0.01f;        // from the start
    std::int64_t warm_up = 0;  // updates of a straight rise from 0
    // From step `first` on the rate is `second`; in order (AlphaGo Zero, AlphaZero).
    std::vector<std::pair<std::int64_t, float>> drops = {};
    // When positive, the rate falls along half a cosine to `last_rate` at this step and stays.
    std::int64_t cosine_steps = 0;
    float last_rate = 0;

    // Of the step that comes after `steps` of the network's, `updates` of them by this optimiser:
    // one that begins upon a taught network warms up as any other.
    float at(std::int64_t steps, std::int64_t updates) const;
};

}  // namespace nn::training
