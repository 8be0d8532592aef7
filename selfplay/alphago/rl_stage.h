// Stage 2 of AlphaGo's training: REINFORCE (Williams 1992) from the supervised policy on, by games
// against a pool of its own snapshots. FOLDER holds the checkpoint to go on from,
// latest.safetensors, the pool in snapshots/ and rl.jsonl. Blocks.
#pragma once

#include <tuple>

#include "engine/base/option.h"
#include "selfplay/alphago/stage.h"
#include "selfplay/training/lesson.h"

namespace selfplay::alphago {

struct RlSettings {
    int seed = 1;
    int games = 128;
    int updates = 0;
    float rate = 0.01f;
    float most_norm = 1;
    int snapshot_updates = 20;
    int judge_games = 100;
    int micro_batch = 64;

    static constexpr auto options() {
        using engine::Option;
        using P = RlSettings;
        return std::tuple{
            Option<P, int>{"seed", &P::seed, 0, 0x7fffffff, "of all randomness"},
            Option<P, int>{"games", &P::games, 2, 100'000, "of an update, played side by side"},
            Option<P, int>{"updates", &P::updates, 0, 100'000'000,
                           "end after so many in all; 0: none is the last"},
            Option<P, float>{"rate", &P::rate, 1e-7f, 10, "of learning"},
            Option<P, float>{"most-norm", &P::most_norm, 0, 1e6f,
                             "of the gradient, else it is scaled; 0: any"},
            Option<P, int>{"snapshot-updates", &P::snapshot_updates, 1, 1'000'000,
                           "after which the policy joins the pool; the paper: 500"},
            Option<P, int>{"judge-games", &P::judge_games, 0, 100'000,
                           "then, against the policy that all began with"},
            Option<P, int>{"micro-batch", &P::micro_batch, 2, 4096,
                           "positions that a thread learns from at once"},
        };
    }
};

// Takes from the lesson of this position, whose moves are the legal ones in their order, those that
// a policy without search never draws: the pass and filled eyes. The softmax it learns by is then
// the one it was drawn from; else moves that lost would be unlearned for the pass, the likeliest
// ones most, and play would go flat wherever it loses.
void keep_sensible(const go::Go& game, training::Lesson& lesson);

// `policy`: the file to begin with. `baseline`: a value network whose word is taken off each
// result, or empty: then the mean result of the update's games of that colour is. Fails with
// engine::Error on what cannot be read and when the numbers run away.
void learn_rl(const StageInput& input, const std::filesystem::path& policy,
              const std::filesystem::path& baseline, const RlSettings& settings,
              const std::stop_token& stop);

}  // namespace selfplay::alphago
