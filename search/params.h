#pragma once

#include "engine/base/option.h"

namespace search {

struct SearchParams {
    int threads = 1;
    int memory_mib = 1024;  // tree, tables and caches together
    int seed = 1;
    float exploration = 0.5f;  // c of UCB1

    static constexpr auto options() {
        using engine::Option;
        using P = SearchParams;
        return std::tuple{
            Option<P, int>{"threads", &P::threads, 1, 1024, "worker threads"},
            Option<P, int>{"memory", &P::memory_mib, 16, 1 << 20, "MiB for tree and caches"},
            Option<P, int>{"seed", &P::seed, 0, 0x7fffffff, "of all randomness"},
            Option<P, float>{"exploration", &P::exploration, 0, 10, "c of UCB1"},
        };
    }
};

}  // namespace search
