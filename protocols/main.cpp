// sanban: one program, one table of subcommands.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <iostream>
#include <span>

#include "engine/base/error.h"
#include "protocols/commands.h"

namespace {

using protocols::Subcommand;

constexpr Subcommand subcommands[] = {
    {"play", "a game in the terminal", protocols::run_play},
    {"gtp", "play Go over GTP", protocols::run_gtp},
    {"uci", "play chess over UCI", protocols::run_uci},
    {"usi", "play shogi over USI", protocols::run_usi},
    {"show", "say what a file of weights or games holds", protocols::run_show},
    {"convert", "write weights and games for other programs", protocols::run_convert},
    {"bench", "measure speed, a figure a line", protocols::run_bench},
    {"perft", "count the positions below one", protocols::run_perft},
    {"solve", "look for the answers of problems", protocols::run_solve},
    {"selfplay", "games of a network against itself", protocols::run_selfplay},
    {"match", "play engines against each other", protocols::run_match},
    {"learn", "make weights from recorded games", protocols::run_learn},
    {"train", "make a network of a game from nothing", protocols::run_train},
};

void describe(std::ostream& out) {
    out << "usage: sanban [COMMAND [ARGUMENT]...]\n\n"
           "Without a command: a game in the terminal, or the protocol (UCI, USI, GTP) that the "
           "first\n"
           "line of piped input is of. `sanban COMMAND --help` lists a command's flags.\n\n";
    for (const auto& [name, help, run] : subcommands) out << "  " << name << "\t" << help << '\n';
}

}  // namespace

int main(int argc, char** argv) try {
    // Standard output belongs to the protocol.
    spdlog::set_default_logger(spdlog::stderr_color_mt("sanban"));
    const std::span arguments(argv, static_cast<std::size_t>(argc));
    if (argc < 2) return protocols::run_bare(arguments.subspan(1));
    const std::string_view wanted = arguments[1];
    for (const auto& subcommand : subcommands)
        if (subcommand.name == wanted) return subcommand.run(arguments.subspan(2));
    if (wanted == "--version") return std::cout << "sanban " SANBAN_VERSION "\n", 0;
    if (wanted == "--help" || wanted == "-h") return describe(std::cout), 0;
    std::cerr << "sanban: there is no command " << wanted << "\n\n";
    describe(std::cerr);
    return 2;
} catch (const engine::Error& error) {
    std::cerr << "sanban: " << error.what() << '\n';
    return 1;
}
