// Stage 1 of AlphaGo's training: from records to the supervised policy network. FOLDER holds the
// checkpoint to go on from, latest.safetensors to play with, and policy.jsonl: how well it
// foretells games held out, over the time learned. Blocks.
#pragma once

#include <tuple>

#include "engine/base/option.h"
#include "selfplay/alphago/stage.h"
#include "selfplay/alphago/stage_network.h"
#include "selfplay/training/learn_settings.h"

namespace selfplay::alphago {

struct PolicySettings {
    int seed = 1, least_moves = 30, games = 0;
    int steps = 0;
    int judged = 2000;
    int report_seconds = 60;
    bool norms = true;

    static constexpr auto options() {
        using engine::Flag;
        using engine::Option;
        using P = PolicySettings;
        return std::tuple{
            Option<P, int>{"seed", &P::seed, 0, 0x7fffffff, "of all randomness"},
            Option<P, int>{"least-moves", &P::least_moves, 1, 1000, "of a game that is kept"},
            Option<P, int>{"games", &P::games, 0, 100'000'000, "read at most; 0: all"},
            Option<P, int>{"steps", &P::steps, 0, 2'000'000'000,
                           "end after so many in all; 0: none is the last"},
            Option<P, int>{"judged", &P::judged, 1, 1'000'000, "positions held out, in a report"},
            Option<P, int>{"report-seconds", &P::report_seconds, 1, 100'000,
                           "between two reports, each with a checkpoint"},
            Flag<P>{"norms", &P::norms,
                    "batch norms while it learns, folded away in the network that plays; the "
                    "paper: none"},
        };
    }
};

// What learning from records begins with. Adam's steps serve networks without batch norms best, and
// are there for --norms false too.
training::LearnSettings policy_learning();

// A network to go on from, learned before in another folder: it alone is taken from the file, not
// what its optimiser knew. Fails with engine::Error unless that is a policy of Go on one board.
nn::Graph policy_to_go_on_from(const std::filesystem::path& file);

// `fresh`: what a new folder begins with. Fails with engine::Error on what cannot be read, on a
// folder of another network or in use, and when the numbers run away.
void learn_policy(const StageInput& input, nn::Graph fresh, const PolicySettings& settings,
                  const training::LearnSettings& learning, const std::stop_token& stop);

}  // namespace selfplay::alphago
