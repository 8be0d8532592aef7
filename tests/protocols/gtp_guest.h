// A GTP engine in process for the tests: lines in, what it answers out.
#pragma once

#include <sstream>
#include <string>

#include "protocols/gtp.h"

namespace protocols {

inline search::SearchParams one_thread() {
    search::SearchParams params;
    params.memory_mib = 16;
    return params;
}

inline GtpSettings small_game(int size = 9, std::uint64_t simulations = 300) {
    GtpSettings settings;
    settings.size = size;
    settings.simulations = simulations;
    return settings;
}

struct GtpGuest {
    explicit GtpGuest(const GtpSettings& settings = small_game())
        : gtp(settings, one_thread(), output) {}

    // All that is written in answer to one line.
    std::string raw(const std::string& line) {
        text.str("");
        gtp.handle(line);
        return text.str();
    }
    // Without the blank line at the end: "= answer" or "? reason".
    std::string say(const std::string& line) {
        auto answer = raw(line);
        while (answer.ends_with('\n') || answer.ends_with(' ')) answer.pop_back();
        return answer;
    }
    // What follows "= "; the whole answer when it is a failure.
    std::string ask(const std::string& line) {
        const auto answer = say(line);
        return answer.starts_with("= ") ? answer.substr(2) : answer;
    }

    std::ostringstream text;
    Output output{text};
    Gtp gtp;
};

inline bool has(const std::string& text, std::string_view part) {
    return text.find(part) != text.npos;
}

}  // namespace protocols
