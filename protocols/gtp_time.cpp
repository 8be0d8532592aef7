#include "protocols/gtp_time.h"

#include <cmath>

#include "protocols/gtp.h"

namespace protocols {

namespace {

constexpr double most_seconds = 7 * 24 * 3600;

search::Milliseconds milliseconds(double seconds) {
    return search::Milliseconds(static_cast<std::int64_t>(std::llround(seconds * 1000)));
}

search::Milliseconds take_seconds(Words& words, std::string_view what) {
    return milliseconds(words.number(what, 0, most_seconds));
}

using search::TimeControl;
using Caps = GtpClock::Caps;

void take_nothing(Words&, TimeControl& control, Caps&) { control.unlimited = true; }

void take_absolute(Words& words, TimeControl& control, Caps&) {
    control.main = take_seconds(words, "the main time");
}

void take_byoyomi(Words& words, TimeControl& control, Caps& caps) {
    take_absolute(words, control, caps);
    control.period = take_seconds(words, "the period");
    control.periods = words.whole("the number of periods", 0, 1000);
}

void take_canadian(Words& words, TimeControl& control, Caps& caps) {
    take_absolute(words, control, caps);
    control.period = take_seconds(words, "the overtime");
    control.period_moves = words.whole("the number of stones", 0, 1000);
    // "No overtime" is written as a time without stones or stones without time.
    control.periods = control.period.count() > 0 && control.period_moves > 0 ? 1 : 0;
    control.period_moves = std::max(control.period_moves, 1);
}

void take_fischer(Words& words, TimeControl& control, Caps& caps) {
    take_absolute(words, control, caps);
    control.increment = take_seconds(words, "the increment");
}

void take_capped(Words& words, TimeControl& control, Caps& caps) {
    take_fischer(words, control, caps);
    caps.most_main = take_seconds(words, "the limit of the main time");
    caps.most_a_move = take_seconds(words, "the longest move");
}

struct Kind {
    std::string_view name;
    void (*take)(Words& words, TimeControl& control, Caps& caps);
    bool kgs;  // kgs-time_settings knows it
};

constexpr Kind kinds[] = {
    {"none", take_nothing, true},     {"absolute", take_absolute, true},
    {"byoyomi", take_byoyomi, true},  {"canadian", take_canadian, true},
    {"fischer", take_fischer, false}, {"fischer-capped", take_capped, false},
};

void take_control(Words& words, bool kgs, GtpClock& clock) {
    const auto name = words.take("the kind");
    for (const auto& kind : kinds) {
        if (kind.name != name || (kgs && !kind.kgs)) continue;
        TimeControl control;
        Caps caps;
        control.unlimited = false;
        kind.take(words, control, caps);
        words.finish();
        return clock.set(control, caps);
    }
    engine::fail("no time settings of the kind {}", name.substr(0, 60));
}

}  // namespace

void GtpClock::set(const TimeControl& control, const Caps& caps) {
    control_ = control;
    caps_ = caps;
    left_.fill(search::TimeLeft::start_of(control));
}

search::TimeLeft GtpClock::for_a_move(engine::Player player) const {
    auto left = this->left(player);
    if (caps_.most_a_move) left.main = std::min(left.main, *caps_.most_a_move);
    return left;
}

void GtpClock::set_left(engine::Player player, double seconds, int stones) {
    auto& left = left_[static_cast<std::size_t>(player)];
    // Some say 0 of nothing when there is no limit.
    if (left.control.unlimited && seconds <= 0) return;
    // A server may tell the time without ever having told the settings.
    left.control.unlimited = false;
    if (stones == 0) {
        left.main = milliseconds(seconds);
        left.periods = left.control.periods;
        left.period = left.control.period;
        return;
    }
    left.main = search::Milliseconds(0);
    left.period = milliseconds(seconds);
    // Under Japanese byo-yomi the number counts periods, else the stones of this one.
    const bool japanese = left.control.periods > 0 && left.control.period_moves == 1;
    left.periods = japanese ? stones : 1;
    left.moves = japanese ? 1 : stones;
    if (!japanese) left.control.period_moves = std::max(left.control.period_moves, stones);
    left.control.periods = std::max(left.control.periods, 1);
}

void GtpClock::spend(engine::Player player, search::Milliseconds used) {
    auto& left = left_[static_cast<std::size_t>(player)];
    left.spend(used);
    if (caps_.most_main) left.main = std::min(left.main, *caps_.most_main);
}

std::string Gtp::time_settings(Words& words) {
    search::TimeControl control;
    control.main = take_seconds(words, "the main time");
    const auto period = words.number("the overtime", 0, most_seconds);
    const int stones = words.whole("the number of stones", 0, 1000);
    // GTP 2: overtime without stones means no time limit at all.
    control.unlimited = period > 0 && stones == 0;
    control.period = milliseconds(period);
    control.periods = period > 0 && stones > 0 ? 1 : 0;
    control.period_moves = std::max(stones, 1);
    clock_.set(control);
    return "";
}

std::string Gtp::kgs_time_settings(Words& words) {
    take_control(words, true, clock_);
    return "";
}

std::string Gtp::kata_time_settings(Words& words) {
    take_control(words, false, clock_);
    return "";
}

std::string Gtp::list_time_settings(Words&) {
    std::string text;
    for (const auto& kind : kinds) text.append(text.empty() ? "" : " ").append(kind.name);
    return text;
}

std::string Gtp::time_left(Words& words) {
    const auto player = words.colour();
    // Some managers send a negative time when a clock has just run out.
    const auto seconds = std::max(words.number("the time", -most_seconds, most_seconds), 0.0);
    clock_.set_left(player, seconds, words.whole("the number of stones", 0, 1000));
    return "";
}

}  // namespace protocols
