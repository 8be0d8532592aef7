// The tunables of the search, each declared once.
#pragma once

#include "engine/base/option.h"

namespace search {

struct SearchParams {
    int threads = 1;
    int memory_mib = 1024;  // tree, tables and caches together
    int seed = 1;
    float exploration = 0.5f;       // c of UCB1, values in [-1, 1]
    float unvisited = 10;           // what UCB1 takes an unvisited move to score
    float rave = 1000;              // own visits that weigh as much as AMAF; 0: plain UCB1
    float rave_exploration = 0.1f;  // c of UCB1 under RAVE, which explores by itself
    float prior_visits = 30;        // AMAF visits that a move's prior counts for under RAVE
    int expand_after = 1;           // visits at which a leaf gets children
    int lag_ms = 20;                // least reserve on the clock; what is measured comes on top
    bool early_end = true;          // of clocked and counted thinks whose best move is settled
    bool early_end_timed = false;

    static constexpr auto options() {
        using engine::Flag;
        using engine::Option;
        using P = SearchParams;
        return std::tuple{
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
            Option<P, float>{"prior-visits", &P::prior_visits, 0, 1e6f,
                             "AMAF visits that a rollout policy's opinion of a move counts for"},
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
