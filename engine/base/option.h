// One row per tunable: its flag, its UCI/USI/GTP name, its range and its help all come
// from here, so no front end ever lists an option by hand.
#pragma once

#include <charconv>
#include <string_view>
#include <tuple>

#include "engine/base/error.h"

namespace engine {

template <class Params, class T>
struct Option {
    std::string_view name;
    T Params::*field;
    T least, most;
    std::string_view help;
};

template <class T>
T parse_number(std::string_view text) {
    T value{};
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc{} || end != text.data() + text.size()) fail("not a number: {}", text);
    return value;
}

// Params::options is a tuple of Option rows.
template <class Params>
void set_option(Params& params, std::string_view name, std::string_view text) {
    const auto try_row = [&]<class T>(const Option<Params, T>& row) {
        if (row.name != name) return false;
        const T value = parse_number<T>(text);
        if (value < row.least || value > row.most)
            fail("{} must lie in {}..{}, not {}", name, row.least, row.most, text);
        params.*row.field = value;
        return true;
    };
    const bool known =
        std::apply([&](const auto&... row) { return (try_row(row) || ...); }, Params::options());
    if (!known) fail("unknown option: {}", name);
}

}  // namespace engine
