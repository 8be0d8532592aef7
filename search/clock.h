// The thinking clock, written once for GTP, UCI and USI: what a side has left, and how much of it
// the next move may take. Pure arithmetic on durations; who measures time passes it in.
#pragma once

#include <chrono>
#include <optional>

namespace search {

using Milliseconds = std::chrono::milliseconds;
using TimePoint = std::chrono::steady_clock::time_point;

// Every control of the three protocols in one form: main time, an increment after each move
// (Fischer), and overtime periods of `period` for `period_moves` moves each (1: Japanese
// byo-yomi, more: Canadian). All zero: no time limit is set only if `unlimited`.
struct TimeControl {
    bool unlimited = true;
    Milliseconds main{0}, increment{0};
    Milliseconds period{0};
    int periods = 0;       // how many overtime periods there are
    int period_moves = 1;  // moves that one period must last for
    // UCI movestogo: main time is refilled after this many moves of a session; 0: never.
    int moves_per_session = 0;
    bool operator==(const TimeControl&) const = default;
};

// What one side has left just before it starts to think.
struct TimeLeft {
    TimeControl control;
    Milliseconds main{0};    // of the main time
    Milliseconds period{0};  // of the running period, once main time is gone
    int periods = 0;         // periods left, the running one included
    int moves = 0;           // moves to make within the running period or session (0: not counting)

    static TimeLeft start_of(const TimeControl& control);
    bool in_overtime() const { return main.count() <= 0 && periods > 0; }
    // Takes `used` for one move off; false when that was more than was left (time is lost).
    bool spend(Milliseconds used);
    // The longest that one move may take without loss.
    Milliseconds longest_move() const;
};

// How long a move should take: the search ends at `soft` unless the best move is unsettled, and
// at `hard` whatever happens. Both already keep the lag reserve.
struct Allotment {
    Milliseconds soft, hard;
};

// `moves_left`: the side's own estimate of its moves to come. `lag`: what passes between the
// opponent's clock and ours, measured. Empty when time is unlimited.
std::optional<Allotment> allot(const TimeLeft& left, int moves_left, Milliseconds lag);

// How long to think for a move that was asked for within `period`, `lag` as above. A moment too
// much runs out no clock: half as much is kept back as of a last period of byo-yomi.
Milliseconds move_within(Milliseconds period, Milliseconds lag);

// How late thinks end after the moment they were asked to, on this machine as loaded as it is:
// the greatest delay seen, old ones fading by a twentieth a think; and what is to be kept back for
// such delays.
class LagMeter {
   public:
    void record(Milliseconds late);
    Milliseconds reserve() const;
    // What to keep back where one waking was so late.
    static Milliseconds reserve_for(Milliseconds late);

   private:
    double greatest_ = 0;  // ms
};

}  // namespace search
