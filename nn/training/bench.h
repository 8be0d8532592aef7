// How many samples a second a learner takes with every core: the figures of `sanban bench learn`.
#pragma once

#include <vector>

#include "engine/base/figure.h"

namespace nn::training {

// Forward, backward and a step of SGD, batches of 256, networks of 5 blocks of 64 channels: of 17
// planes on 9x9 (Go), of 119 planes and 73 planes of moves on 8x8 (chess); in bf16, then in fp32.
// Samples are counted by the clock on the wall, the share of the multiply-add peak by the processor
// time of all threads.
// Blocks for `seconds` a figure.
std::vector<engine::Figure> bench_learner(double seconds = 1);

}  // namespace nn::training
