// One row per tunable: its flag, its UCI/USI/GTP name, its range and its help all come
// from here, so no front end ever lists an option by hand.
//
// A struct of tunables has a static constexpr function options() that returns a tuple of rows:
// Option for numbers, Flag for booleans, Choice for one word out of a few.
#pragma once

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "engine/base/error.h"

namespace engine {

template <class Params, class T>
struct Option {
    std::string_view name;
    T Params::*field;
    T least, most;
    std::string_view help;
};

template <class Params>
struct Flag {
    std::string_view name;
    bool Params::*field;
    std::string_view help;
};

// The field is an enumeration whose values number the words of `choices` from 0.
template <class Params, class T>
struct Choice {
    std::string_view name;
    T Params::*field;
    std::span<const std::string_view> choices;
    std::string_view help;
};

// The whole text, decimal, or engine::Error; NaN and infinities are no numbers.
template <class T>
T parse_number(std::string_view text) {
    T value{};
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = status == std::errc{} && end == text.data() + text.size();
    if (!whole || value != value || value - value != 0) fail("not a number: {}", text);
    return value;
}

// A row as a front end shows it. Numbers as text, so that a row has one type.
struct OptionRow {
    enum class Kind { whole_number, number, flag, choice };
    Kind kind;
    std::string_view name, help;
    std::string value;                          // "true" or "false" for a flag
    std::string least, most;                    // of numbers
    std::span<const std::string_view> choices;  // of choices
};

namespace option {

template <class Params, class T>
void set(const Option<Params, T>& row, Params& params, std::string_view text) {
    T value{};
    try {
        value = parse_number<T>(text);
    } catch (const Error&) {
        fail("{} must be a number in {}..{}, not {}", row.name, row.least, row.most, text);
    }
    if (value < row.least || value > row.most)
        fail("{} must lie in {}..{}, not {}", row.name, row.least, row.most, text);
    params.*row.field = value;
}

template <class Params>
void set(const Flag<Params>& row, Params& params, std::string_view text) {
    const bool yes = text == "true" || text == "1" || text == "on" || text == "yes";
    const bool no = text == "false" || text == "0" || text == "off" || text == "no";
    if (!yes && !no) fail("{} must be true or false, not {}", row.name, text);
    params.*row.field = yes;
}

template <class Params, class T>
void set(const Choice<Params, T>& row, Params& params, std::string_view text) {
    const auto found = std::find(row.choices.begin(), row.choices.end(), text);
    if (found == row.choices.end())
        fail("{} must be one of {}, not {}", row.name, fmt::join(row.choices, ", "), text);
    params.*row.field = static_cast<T>(found - row.choices.begin());
}

template <class Params, class T>
OptionRow describe(const Option<Params, T>& row, const Params& params) {
    const auto kind =
        std::is_integral_v<T> ? OptionRow::Kind::whole_number : OptionRow::Kind::number;
    return {kind,
            row.name,
            row.help,
            fmt::format("{}", params.*row.field),
            fmt::format("{}", row.least),
            fmt::format("{}", row.most),
            {}};
}

template <class Params>
OptionRow describe(const Flag<Params>& row, const Params& params) {
    return {OptionRow::Kind::flag,
            row.name,
            row.help,
            params.*row.field ? "true" : "false",
            {},
            {},
            {}};
}

template <class Params, class T>
OptionRow describe(const Choice<Params, T>& row, const Params& params) {
    const auto index = static_cast<std::size_t>(params.*row.field);
    return {OptionRow::Kind::choice,
            row.name,
            row.help,
            std::string(row.choices[index]),
            {},
            {},
            row.choices};
}

}  // namespace option

// Sets the option `name`; fails, naming the range, when `text` is not in it, and leaves `params`
// as they were.
template <class Params>
void set_option(Params& params, std::string_view name, std::string_view text) {
    const auto try_row = [&](const auto& row) {
        if (row.name != name) return false;
        option::set(row, params, text);
        return true;
    };
    const bool known =
        std::apply([&](const auto&... row) { return (try_row(row) || ...); }, Params::options());
    if (!known) fail("unknown option: {}", name);
}

// All rows in the order of the table, with the values in `params`.
template <class Params>
std::vector<OptionRow> option_rows(const Params& params) {
    const auto all = [&](const auto&... row) {
        return std::vector<OptionRow>{option::describe(row, params)...};
    };
    return std::apply(all, Params::options());
}

}  // namespace engine
