// What bounds a think, and when it is over. Pure decisions on numbers that the caller passes in:
// who searches and who measures time is not known here.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/game.h"
#include "search/clock.h"
#include "search/params.h"

namespace search {

struct Standing;

// Nothing set means until stop().
struct Limits {
    std::optional<std::uint64_t> simulations;  // run by this think
    std::optional<Milliseconds> time;          // exactly this long
    std::optional<TimeLeft> clock;             // as the clock thinks best
    bool ponder = false;                       // limits take effect at ponder_hit()
    std::vector<engine::Move> only, avoid;     // root moves; `only` empty: all
    std::optional<Milliseconds> report_every;  // no reports unless set
    int ply = 0;                               // moves of the game so far

    bool endless() const { return !simulations && !time && !(clock && !clock->control.unlimited); }
};

// Whether no second move can have more visits than the most visited one after `remaining` more.
bool settled(const Standing& standing, std::uint64_t remaining);

// What a level of strength below the full one comes to: simulations a move, and the temperature by
// which the move is drawn from them.
std::uint64_t simulations_of_level(int level);
float temperature_of_level(int level);
// Ratings for GUIs that know no levels: the strongest means full strength. On the scale of
// Stockfish's UCI_Elo, found by matches of maia-1900 (README); other networks differ.
inline constexpr int weakest_elo = 1300, strongest_elo = 2900;
int level_of_elo(int elo);

// The times of one think, from the moment on when its limits took effect.
class Schedule {
   public:
    // `moves_left` and `lag` as for allot().
    Schedule(const Limits& limits, const SearchParams& params, int moves_left, Milliseconds lag);

    // The think must be over then, whatever the search has found.
    std::optional<Milliseconds> hard() const { return hard_; }

    // Whether to end at `elapsed` after `simulations` of this think; to be asked often, since it
    // remembers when the best move last changed. `previous_value`: of the best move when the think
    // began, if it was known.
    bool over(Milliseconds elapsed, std::uint64_t simulations, const Standing& standing,
              std::optional<float> previous_value);

   private:
    bool calm(Milliseconds elapsed, const Standing& standing,
              std::optional<float> previous_value) const;

    std::optional<Milliseconds> soft_, hard_;
    bool early_ = false;
    bool saves_ = false;  // what is left over now is there later
    std::optional<engine::Move> leader_;
    Milliseconds changed_{0};  // when it became that
};

}  // namespace search
