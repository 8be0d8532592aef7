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

void take_canadian(Words& words, search::TimeControl& control) {
    control.period = take_seconds(words, "the overtime");
    control.period_moves = words.whole("the number of stones", 0, 1000);
    // "No overtime" is written as a time without stones or stones without time.
    control.periods = control.period.count() > 0 && control.period_moves > 0 ? 1 : 0;
    control.period_moves = std::max(control.period_moves, 1);
}

search::TimeControl take_control(Words& words, bool fischer_too) {
    search::TimeControl control;
    const auto kind = words.take("the kind");
    if (kind == "none") return control;
    const bool fischer = fischer_too && kind == "fischer";
    if (kind != "absolute" && kind != "byoyomi" && kind != "canadian" && !fischer)
        engine::fail("no time settings of the kind {}", kind);
    control.unlimited = false;
    control.main = take_seconds(words, "the main time");
    if (kind == "byoyomi") {
        control.period = take_seconds(words, "the period");
        control.periods = words.whole("the number of periods", 0, 1000);
    }
    if (kind == "canadian") take_canadian(words, control);
    if (fischer) control.increment = take_seconds(words, "the increment");
    return control;
}

}  // namespace

void GtpClock::set(const search::TimeControl& control) {
    control_ = control;
    left_.fill(search::TimeLeft::start_of(control));
}

void GtpClock::set_left(engine::Player player, double seconds, int stones) {
    auto& left = left_[static_cast<std::size_t>(player)];
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
    left_[static_cast<std::size_t>(player)].spend(used);
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
    clock_.set(take_control(words, false));
    return "";
}

std::string Gtp::kata_time_settings(Words& words) {
    clock_.set(take_control(words, true));
    return "";
}

std::string Gtp::list_time_settings(Words&) { return "none absolute byoyomi canadian fischer"; }

std::string Gtp::time_left(Words& words) {
    const auto player = words.colour();
    // Some managers send a negative time when a clock has just run out.
    const auto seconds = std::max(words.number("the time", -most_seconds, most_seconds), 0.0);
    clock_.set_left(player, seconds, words.whole("the number of stones", 0, 1000));
    return "";
}

}  // namespace protocols
