#include "selfplay/time_text.h"

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "engine/base/error.h"

namespace selfplay {

namespace {

using search::Milliseconds;
using search::TimeControl;

constexpr double most_seconds = 1e7;

struct Kind {
    std::string_view name;
    std::size_t least, most;  // how many numbers follow
    TimeControl (*make)(const std::vector<double>& numbers);
};

Milliseconds duration(double seconds) {
    if (!(seconds >= 0 && seconds <= most_seconds))
        engine::fail("a time must lie in 0..{} s, not {}", most_seconds, seconds);
    return Milliseconds(std::llround(seconds * 1000));
}

int count(double number) {
    if (number != std::floor(number) || number < 1 || number > 1000)
        engine::fail("periods, stones and moves must lie in 1..1000, not {}", number);
    return static_cast<int>(number);
}

TimeControl limited(double main) {
    TimeControl time;
    time.unlimited = false;
    time.main = duration(main);
    return time;
}

TimeControl with_periods(double main, double period, int periods, int moves) {
    auto time = limited(main);
    time.period = duration(period);
    time.periods = periods;
    time.period_moves = moves;
    return time;
}

TimeControl fischer(const std::vector<double>& numbers) {
    auto time = limited(numbers[0]);
    time.increment = duration(numbers[1]);
    return time;
}

TimeControl session(const std::vector<double>& numbers) {
    auto time = limited(numbers[0]);
    time.moves_per_session = count(numbers[1]);
    if (numbers.size() > 2) time.increment = duration(numbers[2]);
    return time;
}

using Numbers = const std::vector<double>&;

constexpr Kind kinds[] = {
    {"none", 0, 0, [](Numbers) { return TimeControl{}; }},
    {"absolute", 1, 1, [](Numbers n) { return limited(n[0]); }},
    {"byoyomi", 3, 3, [](Numbers n) { return with_periods(n[0], n[1], count(n[2]), 1); }},
    {"canadian", 3, 3, [](Numbers n) { return with_periods(n[0], n[1], 1, count(n[2])); }},
    {"fischer", 2, 2, fischer},
    {"session", 2, 3, session},
    {"move", 1, 1, [](Numbers n) { return with_periods(0, n[0], 1, 1); }},
};

}  // namespace

TimeControl time_from_text(std::string_view text) {
    std::istringstream in{std::string(text)};
    std::string name;
    in >> name;
    std::vector<double> numbers;
    for (double number = 0; in >> number;) numbers.push_back(number);
    if (!in.eof()) engine::fail("time control {}: not a number where one must stand", text);
    for (const auto& kind : kinds) {
        if (kind.name != name) continue;
        if (numbers.size() < kind.least || numbers.size() > kind.most)
            engine::fail("time control {} takes {} to {} numbers, not {}", name, kind.least,
                         kind.most, numbers.size());
        const auto time = kind.make(numbers);
        if (!time.unlimited && (time.main + time.period + time.increment).count() == 0)
            engine::fail("time control {}: leaves no time at all", text);
        return time;
    }
    engine::fail(
        "no such time control: {} (none, absolute, byoyomi, canadian, fischer, session, move)",
        name);
}

}  // namespace selfplay
