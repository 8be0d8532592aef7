// Any bytes are GTP: every line is answered or is a comment, and no failure changes the game.
#include <cstdint>
#include <cstdlib>
#include <sstream>

#include "protocols/gtp.h"

namespace {

// Commands that reach outside the program or take time have tests of their own.
bool harmless(const std::string& line) {
    for (const auto* word : {"sgf", "memory", "Memory", "hread", "time", "Time", "Visits", "isits",
                             "layouts", "aram", "option", "analy"})
        if (line.find(word) != line.npos) return false;
    return true;
}

std::string ask(protocols::Gtp& gtp, std::ostringstream& text, const std::string& line) {
    text.str("");
    gtp.handle(line);
    return text.str();
}

void check_line(protocols::Gtp& gtp, std::ostringstream& text, const std::string& line) {
    const auto before = ask(gtp, text, "move_history") + ask(gtp, text, "showboard");
    const auto answer = ask(gtp, text, line);
    if (answer.empty()) return;
    if ((answer[0] != '=' && answer[0] != '?') || !answer.ends_with("\n\n")) std::abort();
    if (answer[0] == '?' && before != ask(gtp, text, "move_history") + ask(gtp, text, "showboard"))
        std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    search::SearchParams params;
    params.memory_mib = 16;
    protocols::GtpSettings settings;
    settings.size = 5;
    settings.simulations = 10;
    std::ostringstream text;
    protocols::Output output(text);
    protocols::Gtp gtp(settings, params, output);
    std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
    protocols::Line line;
    for (int lines = 0; lines < 50 && protocols::read_line(in, line); ++lines)
        if (harmless(line.text)) check_line(gtp, text, line.text);
    return 0;
}
