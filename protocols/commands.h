// The subcommands of the executable. Each gets the arguments behind its own name, parses them, and
// returns the process's exit status; engine::Error for bad input is main()'s to report.
#pragma once

#include <span>
#include <string_view>

namespace protocols {

using Arguments = std::span<char*>;

struct Subcommand {
    std::string_view name, help;
    int (*run)(Arguments);
};

int run_convert(Arguments arguments);
int run_bench(Arguments arguments);
int run_gtp(Arguments arguments);
int run_play(Arguments arguments);
int run_learn(Arguments arguments);
int run_match(Arguments arguments);
int run_perft(Arguments arguments);
int run_selfplay(Arguments arguments);
int run_show(Arguments arguments);
int run_solve(Arguments arguments);
int run_train(Arguments arguments);
int run_uci(Arguments arguments);
int run_usi(Arguments arguments);

// Without any subcommand: the terminal game, or the protocol that the first line of input is of.
int run_bare(Arguments arguments);
// The front ends after their first line has been read already.
int run_gtp_from(Arguments arguments, std::string_view first_line);
int run_uci_from(Arguments arguments, std::string_view first_line);
int run_usi_from(Arguments arguments, std::string_view first_line);

}  // namespace protocols
