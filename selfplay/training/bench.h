// How fast games are played by actors here: what `sanban bench selfplay` prints. Speeds are by the
// processor time of each thread, as those of `sanban bench nn`.
#pragma once

#include <vector>

#include "engine/base/figure.h"
#include "selfplay/training/actor_settings.h"

namespace selfplay::training {

struct SelfPlayBench {
    int threads = 1;
    double seconds = 1;  // for each game, beside as long for the network alone
    ActorSettings actors;
};

// For 9x9 Go, chess and shogi with new networks of 5 blocks of 64 channels, in the fastest
// precision: evals, network evaluations a second of all threads inside self-play; nn_evals, what
// `bench nn` measures for the same network, precision and batch, alternating with it; share, the
// one of the other.
std::vector<engine::Figure> bench_self_play(const SelfPlayBench& settings);

}  // namespace selfplay::training
