// What of the games played is learned from, and how. A value; it may change when a run is resumed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <tuple>

#include "engine/base/option.h"

namespace selfplay::training {

struct ReplaySettings {
    int window = 2000;             // games at first
    float window_exponent = 0.75;  // of its growth
    float window_factor = 0.4f;
    float held_out = 0.03f;
    bool symmetries = true;
    bool fast_searches = false;
    float search_share = 0;
    bool judges_cut_off = false;

    static constexpr auto options() {
        using engine::Flag;
        using engine::Option;
        using P = ReplaySettings;
        return std::tuple{
            Option<P, int>{"window", &P::window, 10, 100'000'000,
                           "games that are learned from at first, and always with a "
                           "window-factor of 0"},
            Option<P, float>{"window-factor", &P::window_factor, 0, 1,
                             "slope of the window's growth once it is full; 0: none"},
            Option<P, float>{"window-exponent", &P::window_exponent, 0.1f, 1,
                             "of the games played, of the window's growth"},
            Option<P, float>{"held-out", &P::held_out, 0, 0.5f,
                             "share of the games that nothing is learned from, to judge by"},
            Flag<P>{"augment", &P::symmetries,
                    "turn and mirror boards at random where the game allows it"},
            Flag<P>{"fast-searches", &P::fast_searches,
                    "learn value and outcome from turns too that have no policy to teach"},
            Option<P, float>{"search-value-share", &P::search_share, 0, 1,
                             "of the value target that is the search's value and not the "
                             "result"},
            Flag<P>{"judge-cut-off", &P::judges_cut_off,
                    "a game cut off at the move limit ends as its last search expected, where "
                    "nothing is counted; else in a draw"},
        };
    }
};

// Games in the window after `games` have been played in all (KataGo's law).
std::size_t window_of(const ReplaySettings& settings, std::uint64_t games);

}  // namespace selfplay::training
