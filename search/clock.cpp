#include "search/clock.h"

#include <algorithm>

namespace search {

namespace {

constexpr Milliseconds none{0}, least{1};
// Of a short period, kept back: of the last, and of one with a spare behind it or with no clock.
constexpr double last_share = 0.2, spare_share = 0.1;

// What one overtime period gives each of its moves.
Milliseconds per_move(const TimeControl& control) {
    return control.periods > 0 ? control.period / std::max(control.period_moves, 1) : none;
}

Allotment within(Milliseconds soft, Milliseconds hard, Milliseconds most) {
    hard = std::max(std::min(hard, most), least);
    return {std::clamp(soft, least, hard), hard};
}

Allotment of_main_time(const TimeLeft& left, int moves_left, Milliseconds lag) {
    const auto& control = left.control;
    // Overtime waits behind the main time, so that may be used up sooner.
    const int to_come = std::max(control.periods > 0 ? moves_left * 2 / 3 : moves_left, 2);
    const int moves = left.moves > 0 ? std::min(left.moves, to_come) : to_come;
    const auto total = left.main + (moves - 1) * control.increment - moves * lag;
    const auto overtime = control.period_moves > 1 ? per_move(control) : control.period;
    const auto soft = std::max(total / moves, per_move(control) - lag);
    // The last move before a refill may take all; before that, leave something for each.
    const auto spare = moves == 1 ? none : std::min(left.main / 2, (moves - 1) * 2 * lag);
    const auto most =
        left.main - lag - spare + (control.periods > 0 ? std::max(overtime - lag, none) : none);
    return within(soft, moves == 1 ? soft : 3 * soft, most);
}

// The time of a move within its period; of a period of up to a second at least `share` is kept
// back.
Milliseconds within_period(Milliseconds period, Milliseconds lag, double share) {
    using std::chrono::duration_cast;
    const auto fewest = duration_cast<Milliseconds>(share * std::min(period, Milliseconds(1000)));
    const auto reserve = std::max(lag, std::clamp(period / 20, fewest, Milliseconds(300)));
    return std::max(period - std::min(reserve, period / 2), least);
}

Allotment of_overtime(const TimeLeft& left, Milliseconds lag) {
    const int moves = std::max(left.moves, 1);
    if (moves == 1) {
        const auto now = within_period(left.period, lag, last_share);
        if (left.periods <= 1 || left.control.period_moves > 1) return within(now, now, now);
        // A spare period may go on a hard move, or on a moment too much; the last may not.
        const auto most = now + left.control.period;
        return within(within_period(left.period, lag, spare_share), most, most);
    }
    const auto soft = left.period / moves - lag;
    return within(soft, 3 * soft, left.period - lag - (moves - 1) * std::max(soft / 2, lag));
}

}  // namespace

Milliseconds move_within(Milliseconds period, Milliseconds lag) {
    return within_period(period, lag, spare_share);
}

TimeLeft TimeLeft::start_of(const TimeControl& control) {
    TimeLeft left;
    left.control = control;
    left.main = control.main;
    left.period = control.period;
    left.periods = control.periods;
    left.moves = control.main > none ? control.moves_per_session : control.period_moves;
    return left;
}

bool TimeLeft::spend(Milliseconds used) {
    if (control.unlimited) return true;
    if (!in_overtime()) {
        if (used <= main && main > none) {
            main += control.increment - used;
            if (moves > 0 && --moves == 0) {
                main += control.main;
                moves = control.moves_per_session;
            }
            return true;
        }
        used -= std::max(main, none);
        main = none;
        if (periods == 0) return false;
        period = control.period;
        moves = control.period_moves;
    }
    while (used > period) {
        used -= period;
        if (--periods <= 0) return false;
        period = control.period;
        moves = control.period_moves;
    }
    period -= used;
    if (--moves <= 0) {
        period = control.period;
        moves = control.period_moves;
    }
    return true;
}

Milliseconds TimeLeft::longest_move() const {
    if (control.unlimited) return Milliseconds::max();
    if (in_overtime()) return period + (periods - 1) * control.period;
    return std::max(main, none) + periods * control.period;
}

std::optional<Allotment> allot(const TimeLeft& left, int moves_left, Milliseconds lag) {
    if (left.control.unlimited) return std::nullopt;
    return left.in_overtime() ? of_overtime(left, lag) : of_main_time(left, moves_left, lag);
}

void LagMeter::record(Milliseconds late) {
    const double now = static_cast<double>(std::max(late, none).count());
    greatest_ = std::max(now, greatest_ * 0.95);
}

Milliseconds LagMeter::reserve() const {
    return reserve_for(Milliseconds(static_cast<std::int64_t>(greatest_)));
}

// Of the wakings between the two clocks (ours to think, to end, to answer; the manager's to read)
// we see one.
Milliseconds LagMeter::reserve_for(Milliseconds late) { return 4 * late; }

}  // namespace search
