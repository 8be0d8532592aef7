// The tunables of the search, each declared once.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "engine/base/option.h"
#include "search/evaluator.h"

namespace search {

// How a search goes about it; without a network always by games played out.
enum class Method : std::uint8_t { automatic, uct, puct, gumbel, alphago };
inline constexpr std::array<std::string_view, 5> method_names = {"auto", "uct", "puct", "gumbel",
                                                                 "alphago"};

inline constexpr int full_level = 20;

struct SearchParams {
    Method method = Method::automatic;
    int threads = 1;
    int memory_mib = 1024;  // tree, tables and caches together
    int seed = 1;
    float exploration = 0.5f;       // c of UCB1, values in [-1, 1]
    float unvisited = 10;           // what UCB1 takes an unvisited move to score
    float rave = 1000;              // own visits that weigh as much as AMAF; 0: plain UCB1
    float rave_exploration = 0.1f;  // c of UCB1 under RAVE, which explores by itself
    float prior_visits = 30;        // AMAF visits that a move's prior counts for under RAVE
    float cpuct = 1.25f;            // c of PUCT
    float cpuct_base = 19652, cpuct_factor = 1;
    float fpu_reduction = 0.25f, root_fpu_reduction = 0.25f;
    float virtual_loss = 1;
    float policy_temperature = 0,
          root_policy_temperature = 0;  // 0: what suits the network; as elsewhere
    float noise = 0, noise_alpha = 0;   // of the priors at the root (Dirichlet)
    int gumbel_moves = 16;              // root moves that take part (gumbel)
    float gumbel_visits = 50, gumbel_scale = 1, gumbel_noise = 0;
    float lambda = -1;  // share of rollouts in a value, -1: what suits; not of uct
    int rollouts = 4;   // whose mean it is a share of, a leaf (puct and gumbel, Go)
    int n_thr = 0;
    float network_share = 0.5f;
    Prior prior = Prior::supervised;
    float alphago_cpuct = 5, alphago_temperature = 0.67f, alphago_virtual_loss = 3;
    float temperature = 0;      // of the choice of a move by its visits
    int temperature_plies = 0;  // moves of a game that it is for; 0: all
    float draw_score = 0;       // what a draw is worth to the side that thinks, -1..1
    bool solver = true;         // proven wins and losses are backed up
    bool lower_bound = true;    // the final move is the best even if values disappoint (networks)
    int level = full_level;     // of strength
    int batch = 0;  // leaves that a worker asks the network about at once; 0: what suits
    bool root_symmetries = false;
    int expand_after = 1;   // visits at which a leaf gets children
    int lag_ms = 20;        // least reserve on the clock; what is measured comes on top
    bool early_end = true;  // of clocked and counted thinks whose best move is settled
    bool early_end_timed = false;

    static constexpr auto options() {
        using engine::Choice;
        using engine::Flag;
        using engine::Option;
        using P = SearchParams;
        return std::tuple{
            Choice<P, Method>{"search", &P::method, method_names,
                              "auto: puct with a network, alphago with a folder of AlphaGo's, uct "
                              "(games played out) without; gumbel: puct below a root that halves "
                              "its candidates; alphago: rollouts and networks blended"},
            Option<P, int>{"threads", &P::threads, 1, 1024, "worker threads"},
            Option<P, int>{"memory", &P::memory_mib, 16, 1 << 20, "MiB for tree and caches"},
            Option<P, int>{"seed", &P::seed, 0, 0x7fffffff, "of all randomness"},
            Option<P, float>{"exploration", &P::exploration, 0, 10, "c of UCB1"},
            Option<P, float>{"unvisited", &P::unvisited, -10, 10,
                             "score of an unvisited move; 10: each is tried first"},
            Option<P, float>{"rave", &P::rave, 0, 1e6f,
                             "visits at which a move's own value weighs as much as AMAF; 0: none"},
            Option<P, float>{"rave-exploration", &P::rave_exploration, 0, 10,
                             "c of UCB1 with RAVE"},
            Option<P, float>{
                "prior-visits", &P::prior_visits, 0, 1e6f,
                "AMAF visits that a rollout policy's opinion of a move counts for in a "
                "large search; fewer in a small one"},
            Option<P, float>{"cpuct", &P::cpuct, 0, 100, "c of PUCT"},
            Option<P, float>{"cpuct-factor", &P::cpuct_factor, 0, 100,
                             "growth of c with the logarithm of visits; 0: constant"},
            Option<P, float>{"cpuct-base", &P::cpuct_base, 1, 1e9f, "visits at which c grows"},
            Option<P, float>{"fpu-reduction", &P::fpu_reduction, -10, 10,
                             "how much worse than its parent an unvisited move is taken to be"},
            Option<P, float>{"root-fpu-reduction", &P::root_fpu_reduction, -10, 10,
                             "likewise at the root"},
            Option<P, float>{"virtual-loss", &P::virtual_loss, 0, 100,
                             "losses that a visit under way counts (puct)"},
            Option<P, float>{"policy-temperature", &P::policy_temperature, 0, 10,
                             "of the network's priors; above 1 they are evened out; 0: what suits "
                             "it, 1.7 for chess and 1.5 for shogi by sanban's training, else 1"},
            Option<P, float>{"root-policy-temperature", &P::root_policy_temperature, 0, 10,
                             "likewise at the root; 0: as elsewhere"},
            Option<P, float>{"noise", &P::noise, 0, 1,
                             "share of Dirichlet's noise in the priors at the root"},
            Option<P, float>{"noise-alpha", &P::noise_alpha, 0, 100,
                             "its concentration; 0: 10 over the number of moves"},
            Option<P, int>{"gumbel-moves", &P::gumbel_moves, 1, 1000,
                           "root moves that take part (gumbel)"},
            Option<P, float>{"gumbel-visits", &P::gumbel_visits, 0, 1e6f, "c_visit (gumbel)"},
            Option<P, float>{"gumbel-scale", &P::gumbel_scale, 0, 1000, "c_scale (gumbel)"},
            Option<P, float>{"gumbel-noise", &P::gumbel_noise, 0, 10,
                             "of the choice of candidates; 1 in self-play (gumbel)"},
            Option<P, float>{"lambda", &P::lambda, -1, 1,
                             "share of rollouts (chess, shogi: of captures played out) in a value, "
                             "the rest is the network's; all where it has no value; -1: what "
                             "suits, half in alphago, else for networks by sanban's training what "
                             "makes them strongest"},
            Option<P, int>{"rollouts", &P::rollouts, 1, 100,
                           "games played out from each leaf where lambda gives them a share (Go, "
                           "puct and gumbel)"},
            Option<P, int>{"n-thr", &P::n_thr, 0, 100'000,
                           "visits at which a leaf gets children and networks are asked (alphago); "
                           "0: as many as give networks their share; the paper: 40 at first"},
            Option<P, float>{"network-share", &P::network_share, 0.01f, 0.99f,
                             "of the time, by measurement, with n-thr 0 (alphago)"},
            Choice<P, Prior>{"prior", &P::prior, prior_names,
                             "policy network that the priors are of (alphago)"},
            Option<P, float>{"alphago-cpuct", &P::alphago_cpuct, 0, 100, "c of PUCT (alphago)"},
            Option<P, float>{"alphago-temperature", &P::alphago_temperature, 0.1f, 10,
                             "of the priors (alphago)"},
            Option<P, float>{"alphago-virtual-loss", &P::alphago_virtual_loss, 0, 100,
                             "rollouts lost that a visit under way counts (alphago)"},
            Option<P, float>{"temperature", &P::temperature, 0, 10,
                             "moves are drawn by visits^(1/temperature); 0: the best"},
            Option<P, int>{"temperature-plies", &P::temperature_plies, 0, 1000,
                           "first moves of a game that it is for; 0: all"},
            Option<P, float>{"draw-score", &P::draw_score, -1, 1,
                             "what a draw is worth to the side that thinks"},
            Flag<P>{"solver", &P::solver, "back up proven wins, losses and draws"},
            Flag<P>{"lower-bound", &P::lower_bound,
                    "choose the move by the lower confidence bound of its value (puct)"},
            Option<P, int>{"level", &P::level, 0, full_level,
                           "of strength, by visits and temperature; 20: full"},
            Option<P, int>{"batch", &P::batch, 0, most_batch,
                           "positions a worker evaluates at once, at most, in a tree large enough; "
                           "0: what suits network and board"},
            Flag<P>{"root-symmetries", &P::root_symmetries,
                    "average the network over all symmetries at the root"},
            Option<P, int>{"expand-after", &P::expand_after, 1, 1000,
                           "visits at which a leaf gets children"},
            Option<P, int>{"lag", &P::lag_ms, 0, 10000,
                           "ms kept back on the clock, beside what is measured"},
            Flag<P>{"early-end", &P::early_end, "stop when the best move can no longer be caught"},
            Flag<P>{"early-end-timed", &P::early_end_timed,
                    "likewise when a fixed time a move was asked for"},
        };
    }
};

}  // namespace search
