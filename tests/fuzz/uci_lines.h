// Any bytes are UCI, or USI: only protocol is answered, a think has one answer and nothing comes
// behind it, and no failure changes the position.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <sstream>
#include <string>
#include <utility>

#include "protocols/uci.h"

namespace fuzz {

// These take memory and threads as they are told to.
inline bool harmless(const std::string& line) {
    for (const auto* word : {"hread", "ash", "HREAD", "ASH"})
        if (line.find(word) != line.npos) return false;
    return true;
}

inline void check_answer(const std::string& text) {
    std::istringstream lines(text);
    int answers = 0;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (answers > 0) std::abort();
        bool known = false;
        for (const auto* reply : {"id", "option", "uciok", "usiok", "readyok", "info"})
            known |= word == reply;
        const bool answer = word == "bestmove" || word == "checkmate";
        if (!known && !answer) std::abort();
        answers += answer;
    }
}

template <class G>
int check_lines(const protocols::Dialect& dialect, const std::uint8_t* data, std::size_t size) {
    search::SearchParams params;
    params.memory_mib = 16;
    auto session = std::make_unique<protocols::GameSession<G>>(params);
    const auto& game = *session;
    std::ostringstream text;
    protocols::Output output(text);
    protocols::Uci uci(dialect, std::move(session), "sanban", output);
    std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
    protocols::Line line;
    for (int lines = 0; lines < 50 && protocols::read_line(in, line); ++lines) {
        if (!harmless(line.text)) continue;
        const auto before = game.position_text();
        text.str("");
        if (!uci.handle(line.text)) break;
        uci.handle("stop");
        check_answer(text.str());
        if (text.str().starts_with("info string error") && before != game.position_text())
            std::abort();
    }
    return 0;
}

}  // namespace fuzz
