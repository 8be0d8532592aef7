// A GUI at the other end of the UCI or USI front end, for tests.
#pragma once

#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "protocols/uci.h"

namespace protocols::testing {

inline search::SearchParams small_memory() {
    search::SearchParams params;
    params.memory_mib = 16;
    return params;
}

template <engine::Game G>
struct UciGuest {
    explicit UciGuest(const Dialect& dialect = uci_dialect)
        : uci(dialect, std::make_unique<GameSession<G>>(small_memory()), "sanban", output) {}

    // What the lines are answered with.
    std::string say(const std::string& lines) {
        text.str("");
        std::istringstream in(lines);
        uci.serve(in);
        return text.str();
    }

    std::ostringstream text;
    Output output{text};
    Uci uci;
};

inline bool has(const std::string& text, std::string_view part) {
    return text.find(part) != text.npos;
}

inline std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

// Which a bestmove must be; empty when nothing was said.
inline std::string last_line(const std::string& text) {
    const auto lines = lines_of(text);
    return lines.empty() ? std::string() : lines.back();
}

}  // namespace protocols::testing
