// From records to AlphaGo's linear policies: FOLDER/rollout.safetensors, the rollout policy and the
// tree policy, and FOLDER/rollout.jsonl, how well they foretell games held out. Blocks.
#pragma once

#include <tuple>

#include "engine/base/option.h"
#include "selfplay/alphago/stage.h"

namespace selfplay::alphago {

struct RolloutSettings {
    int seed = 1, size = 19, least_moves = 30, games = 0;
    int positions = 3'000'000;
    float rate = 0.1f;
    int judged = 20'000;
    int report_seconds = 60;

    static constexpr auto options() {
        using engine::Option;
        using P = RolloutSettings;
        return std::tuple{
            Option<P, int>{"seed", &P::seed, 0, 0x7fffffff, "of all randomness"},
            Option<P, int>{"size", &P::size, go::min_size, go::max_size, "of the board"},
            Option<P, int>{"least-moves", &P::least_moves, 1, 1000, "of a game that is kept"},
            Option<P, int>{"games", &P::games, 0, 100'000'000, "read at most; 0: all"},
            Option<P, int>{"positions", &P::positions, 1, 2'000'000'000,
                           "learned from in all, earlier calls counted"},
            Option<P, float>{"rate", &P::rate, 1e-5f, 10, "of learning"},
            Option<P, int>{"judged", &P::judged, 1, 10'000'000, "positions held out, in a report"},
            Option<P, int>{"report-seconds", &P::report_seconds, 1, 100'000,
                           "between two reports, each with a checkpoint"},
        };
    }
};

// Goes on from the file that is there. Fails with engine::Error on what cannot be read.
void learn_rollout(const StageInput& input, const RolloutSettings& settings,
                   const std::stop_token& stop);

}  // namespace selfplay::alphago
