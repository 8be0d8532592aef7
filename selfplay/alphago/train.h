// All stages of AlphaGo's training in their order in one folder, each in a folder of its own below:
// rollout, policy, rl, value. What a stage has finished stands in FOLDER/weights, which is a set
// that `--search alphago` plays with; stages that have are not begun again. FOLDER/report.html
// shows their curves as they go. Blocks.
#pragma once

#include <tuple>

#include "engine/base/option.h"
#include "selfplay/alphago/policy_stage.h"
#include "selfplay/alphago/rl_stage.h"
#include "selfplay/alphago/rollout_stage.h"
#include "selfplay/alphago/value_stage.h"

namespace selfplay::alphago {

struct TrainSettings {
    int seed = 1;
    int rollout_positions = 1'000'000;
    int policy_steps = 20'000;
    int rl_updates = 200, rl_games = 128;
    int value_games = 20'000, value_steps = 5'000;
    int games = 0;

    static constexpr auto options() {
        using engine::Option;
        using P = TrainSettings;
        return std::tuple{
            Option<P, int>{"seed", &P::seed, 0, 0x7fffffff, "of all randomness"},
            Option<P, int>{"expert-games", &P::games, 0, 100'000'000, "read at most; 0: all"},
            Option<P, int>{"rollout-positions", &P::rollout_positions, 1, 2'000'000'000,
                           "that the linear policies learn from"},
            Option<P, int>{"policy-steps", &P::policy_steps, 1, 2'000'000'000,
                           "of the supervised policy"},
            Option<P, int>{"rl-updates", &P::rl_updates, 1, 100'000'000,
                           "of the reinforced policy"},
            Option<P, int>{"rl-games", &P::rl_games, 2, 100'000, "of each of them"},
            Option<P, int>{"value-games", &P::value_games, 20, 100'000'000,
                           "that the value network learns from"},
            Option<P, int>{"value-steps", &P::value_steps, 1, 2'000'000'000,
                           "of the value network"},
        };
    }
};

// Fails with engine::Error as the stages do.
void train_alphago(const StageInput& input, const StageNetwork& network,
                   const TrainSettings& settings, const std::stop_token& stop);

}  // namespace selfplay::alphago
