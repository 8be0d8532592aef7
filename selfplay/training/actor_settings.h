// How self-play games are played: every tunable of an actor, declared once. A value.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "engine/base/option.h"

namespace selfplay::training {

// How a search explores at the root, and what the policy is taught from it.
enum class Exploration : std::uint8_t {
    gumbel,  // moves by Gumbel-top-k and sequential halving; the target is the improved policy
    noise,   // PUCT with Dirichlet noise; the target is the visit counts
};
inline constexpr std::array<std::string_view, 2> exploration_names = {"gumbel", "noise"};

struct ActorSettings {
    int games = 32;  // that a thread advances together
    int batch = 8;   // positions that it asks the network about at once
    Exploration exploration = Exploration::gumbel;
    // A full search teaches the policy; the rest of the turns get a fast one that does not
    // (playout-cap randomisation, Wu 2019).
    int simulations = 16, fast_simulations = 16;
    float full_share = 1;  // of turns
    int candidates = 16;
    float gumbel_scale = 1;
    float noise_share = 0.25f, noise_alpha = 0;
    float cpuct = 1.25f, fpu_reduction = 0.25f;
    float lambda = 0;
    int rollouts = 4;
    bool symmetries = true;
    float temperature = 1, late_temperature = 0;
    int temperature_moves = 30;
    float opening_share = 0.75f;
    int opening_moves = 6;
    float scattered_share = 0;
    float resign = -0.9f;
    int resign_turns = 3;
    float play_on_share = 0.1f, resign_errors = 0.05f;
    int move_limit = 0;
    int size = 9, least_size = 0;
    float small_share = 0.25f;
    float komi = 7.5f, komi_deviation = 0;

    static constexpr auto options() {
        using engine::Choice;
        using engine::Flag;
        using engine::Option;
        using S = ActorSettings;
        return std::tuple{
            Option<S, int>{"games-at-once", &S::games, 1, 1024, "games that a thread advances"},
            Option<S, int>{"batch", &S::batch, 1, 256, "positions a thread evaluates at once"},
            Choice<S, Exploration>{"exploration", &S::exploration, exploration_names,
                                   "gumbel: by sequential halving, which teaches well from few "
                                   "simulations; noise: PUCT with Dirichlet noise"},
            Option<S, int>{"simulations", &S::simulations, 1, 100000, "of a full search"},
            Option<S, int>{"fast-simulations", &S::fast_simulations, 1, 100000,
                           "of a search that does not teach the policy"},
            Option<S, float>{"full-share", &S::full_share, 0, 1, "turns with a full search"},
            Option<S, int>{"candidates", &S::candidates, 1, 640,
                           "gumbel: root moves that the halving begins with"},
            Option<S, float>{"gumbel-scale", &S::gumbel_scale, 0, 100,
                             "gumbel: weight of values against priors"},
            Option<S, float>{"noise-share", &S::noise_share, 0, 1,
                             "noise: of the root's priors in a full search"},
            Option<S, float>{"noise-alpha", &S::noise_alpha, 0, 100,
                             "noise: of Dirichlet's distribution; 0: 10 / legal moves"},
            Option<S, float>{"cpuct", &S::cpuct, 0, 100, "c of PUCT"},
            Option<S, float>{"fpu-reduction", &S::fpu_reduction, -10, 10,
                             "how much worse than its parent an unvisited move is taken to be"},
            Option<S, float>{"lambda", &S::lambda, 0, 1,
                             "share of a game played out, in chess and shogi of captures played "
                             "out, in a position's value; the rest is the network's"},
            Option<S, int>{"rollouts", &S::rollouts, 1, 100,
                           "Go: games played out from a position where lambda gives them a share"},
            Flag<S>{"symmetries", &S::symmetries, "turn the board at random for the network"},
            Option<S, float>{"temperature", &S::temperature, 0, 10,
                             "noise: of the choice among visited moves"},
            Option<S, float>{"late-temperature", &S::late_temperature, 0, 10,
                             "likewise after temperature-moves"},
            Option<S, int>{"temperature-moves", &S::temperature_moves, 0, 10000,
                           "moves of both played at the first temperature"},
            Option<S, float>{"opening-share", &S::opening_share, 0, 1,
                             "games that begin with moves drawn from the policy"},
            Option<S, int>{"opening-moves", &S::opening_moves, 1, 1000, "their mean number"},
            Option<S, float>{"scattered-share", &S::scattered_share, 0, 1,
                             "chess: games that begin with some of the men, on squares at random"},
            Option<S, float>{"resign", &S::resign, -1, 0,
                             "value below which a side gives up at the earliest; -1: never"},
            Option<S, int>{"resign-turns", &S::resign_turns, 1, 100,
                           "turns in a row that it must be so low"},
            Option<S, float>{"play-on-share", &S::play_on_share, 0, 1,
                             "games without resignation, by which it is checked"},
            Option<S, float>{"resign-errors", &S::resign_errors, 0, 1,
                             "most of those given up that may have been saved"},
            Option<S, int>{"move-limit", &S::move_limit, 0, 100000,
                           "moves of both; 0: two a point in Go, else 512"},
            Option<S, int>{"size", &S::size, 2, 25, "Go: of the board"},
            Option<S, int>{"least-size", &S::least_size, 0, 25,
                           "Go: of the smallest board; 0: one size only"},
            Option<S, float>{"small-share", &S::small_share, 0, 1, "Go: games on smaller boards"},
            Option<S, float>{"komi", &S::komi, -1000, 1000, "Go: mean, a multiple of 0.5"},
            Option<S, float>{"komi-deviation", &S::komi_deviation, 0, 100,
                             "Go: standard deviation of komi, in whole points"},
        };
    }
};

// Fails with engine::Error, saying which, on settings that do not fit each other.
void check(const ActorSettings& settings);

}  // namespace selfplay::training
