// Stage 3 of AlphaGo's training: games in which the supervised policy plays up to a drawn move,
// then one move is drawn uniformly and the reinforced policy plays on, and a value network that
// learns the outcome from the one position after the drawn move; or, as the paper's
// counter-example, from every position of the same games. Where the machine is too small to play
// so many, games by others take their place. FOLDER holds games/, checkpoints,
// latest.safetensors and value.jsonl; the counter-example's stand in FOLDER/all. Blocks.
#pragma once

#include <array>
#include <tuple>

#include "engine/base/option.h"
#include "nn/graph.h"
#include "selfplay/alphago/stage.h"
#include "selfplay/training/learn_settings.h"

namespace selfplay::alphago {

enum class Taught : std::uint8_t { one, all };
inline constexpr std::array<std::string_view, 2> taught_names = {"one", "all"};

struct ValueSettings {
    int seed = 1;
    int games = 10'000;
    Taught positions = Taught::one;
    int steps = 0;
    int judged = 2000;
    int report_seconds = 60;
    bool norms = true;
    int pooled = 0;

    static constexpr auto options() {
        using engine::Choice;
        using engine::Flag;
        using engine::Option;
        using P = ValueSettings;
        return std::tuple{
            Option<P, int>{"seed", &P::seed, 0, 0x7fffffff, "of all randomness"},
            Option<P, int>{"games", &P::games, 20, 100'000'000,
                           "played in all before learning begins; of records at most"},
            Choice<P, Taught>{"positions", &P::positions, taught_names,
                              "learned from of each game: one, or all, which overfits"},
            Option<P, int>{"steps", &P::steps, 0, 2'000'000'000,
                           "end after so many in all; 0: none is the last"},
            Option<P, int>{"judged", &P::judged, 1, 1'000'000, "positions held out, in a report"},
            Option<P, int>{"report-seconds", &P::report_seconds, 1, 100'000,
                           "between two reports, each with a checkpoint"},
            Flag<P>{"norms", &P::norms,
                    "batch norms while it learns, folded away in the network that plays; the "
                    "paper: none"},
            Option<P, int>{"pooled", &P::pooled, 0, 1024,
                           "filters of the head, of which the means over the board are looked at; "
                           "0: one plane, point by point, as in the paper"},
        };
    }
};

// The networks that play, the supervised and the reinforced policy; a value network has the layers
// and filters of the latter.
struct ValuePlayers {
    std::filesystem::path policy, reinforced;
};

// Plays what is lacking, then learns. Fails with engine::Error on what cannot be read and when the
// numbers run away.
void learn_value(const StageInput& input, const ValuePlayers& players,
                 const ValueSettings& settings, const training::LearnSettings& learning,
                 const std::stop_token& stop);

// From how games by others ended, the records of the input: of each, one position that is drawn
// once for all, or another one each time. `fresh`: the value network to begin with. Fails likewise.
void learn_value_from_records(const StageInput& input, const nn::Graph& fresh,
                              const ValueSettings& settings,
                              const training::LearnSettings& learning, const std::stop_token& stop);

}  // namespace selfplay::alphago
