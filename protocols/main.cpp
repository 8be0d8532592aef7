// sanban: one program, one table of subcommands.
#include <iostream>
#include <span>

#include "engine/base/error.h"
#include "protocols/commands.h"

namespace {

using protocols::Subcommand;

constexpr Subcommand subcommands[] = {
    {"gtp", "play Go over GTP", protocols::run_gtp},
    {"uci", "play chess over UCI", protocols::run_uci},
    {"usi", "play shogi over USI", protocols::run_usi},
    {"show", "say what a weight file holds", protocols::run_show},
    {"convert", "write foreign weights as ours", protocols::run_convert},
    {"bench", "measure speed, a figure a line", protocols::run_bench},
    {"perft", "count the positions below one", protocols::run_perft},
};

int usage(std::ostream& out) {
    out << "usage: sanban COMMAND [ARGUMENT]...\n";
    for (const auto& [name, help, run] : subcommands) out << "  " << name << "\t" << help << '\n';
    return 2;
}

}  // namespace

int main(int argc, char** argv) try {
    const std::span arguments(argv, static_cast<std::size_t>(argc));
    if (argc < 2) return usage(std::cerr);
    for (const auto& subcommand : subcommands)
        if (subcommand.name == arguments[1]) return subcommand.run(arguments.subspan(2));
    return usage(std::cerr);
} catch (const engine::Error& error) {
    std::cerr << "sanban: " << error.what() << '\n';
    return 1;
}
