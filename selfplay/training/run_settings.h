// How self-play and learning take turns in a run, and what is kept of it. A value; it may change
// when a run is resumed.
#pragma once

#include <array>
#include <string_view>
#include <tuple>

#include "engine/base/option.h"
#include "nn/executor.h"

namespace selfplay::training {

inline constexpr std::array<std::string_view, 4> precision_names = {"fp32", "bf16", "int8",
                                                                    "int16"};

struct RunSettings {
    int seed = 1;
    float ratio = 4;
    float learner_share = 0.4f;
    int first_games = 100;
    int rollout_games = 0, rollout_simulations = 100;
    int refresh = 50;
    int last_simulations = 64, growth_games = 40'000;
    nn::Precision precision = nn::Precision::int16;
    int keep_mib = 4096;

    bool gate = false;
    int gate_games = 400;
    float gate_score = 0.55f;
    int gate_simulations = 100;

    float ladder_share = 0.04f;
    int snapshot_minutes = 30;
    int ladder_simulations = 100;
    int report_minutes = 2;

    static constexpr auto options() {
        using engine::Choice;
        using engine::Flag;
        using engine::Option;
        using P = RunSettings;
        return std::tuple{
            Option<P, int>{"seed", &P::seed, 0, 0x7fffffff, "of all randomness"},
            Option<P, float>{"ratio", &P::ratio, 0.01f, 1000,
                             "samples learned from for each new position"},
            Option<P, float>{"learner-share", &P::learner_share, 0.01f, 0.99f,
                             "of the time, at most, that goes to learning"},
            Option<P, int>{"first-games", &P::first_games, 1, 10'000'000,
                           "games played before learning begins"},
            Option<P, int>{"rollout-games", &P::rollout_games, 0, 10'000'000,
                           "games in which rollouts judge, before the network takes over"},
            Option<P, int>{"rollout-simulations", &P::rollout_simulations, 1, 100'000,
                           "of every search there"},
            Option<P, int>{"refresh", &P::refresh, 1, 1'000'000,
                           "steps after which the new weights are saved and play"},
            Option<P, int>{"last-simulations", &P::last_simulations, 0, 100'000,
                           "of a full search after growth-games; 0: as simulations"},
            Option<P, int>{"growth-games", &P::growth_games, 0, 1'000'000'000,
                           "games in which simulations grow to last-simulations"},
            Choice<P, nn::Precision>{"precision", &P::precision, precision_names,
                                     "of the network that plays"},
            Option<P, int>{"keep", &P::keep_mib, 16, 1 << 24,
                           "MiB of recorded games; the oldest are removed"},
            Flag<P>{"gate", &P::gate, "new weights play only once they have beaten the old"},
            Option<P, int>{"gate-games", &P::gate_games, 2, 100'000, "of the match for that"},
            Option<P, float>{"gate-score", &P::gate_score, 0.01f, 0.99f,
                             "share of the points that must be exceeded"},
            Option<P, int>{"gate-simulations", &P::gate_simulations, 1, 100'000, "of a move there"},
            Option<P, float>{"ladder-share", &P::ladder_share, 0, 0.5f,
                             "of the time that goes to games that measure strength"},
            Option<P, int>{"snapshot-minutes", &P::snapshot_minutes, 1, 100'000,
                           "at most between two networks that are kept and measured"},
            Option<P, int>{"ladder-simulations", &P::ladder_simulations, 1, 100'000,
                           "of our moves in games that measure strength"},
            Option<P, int>{"report-minutes", &P::report_minutes, 1, 10'000,
                           "between two writings of report.html"},
        };
    }
};

}  // namespace selfplay::training
