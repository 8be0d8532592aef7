// `sanban gtp`.
#include <fmt/format.h>

#include <cstdio>
#include <iostream>

#include "protocols/commands.h"
#include "protocols/flags.h"
#include "protocols/gtp.h"

namespace protocols {

int run_gtp(Arguments arguments) { return run_gtp_from(arguments, ""); }

int run_gtp_from(Arguments arguments, std::string_view first_line) {
    CLI::App app("Go over the Go Text Protocol", "sanban gtp");
    GtpSettings settings;
    search::SearchParams params;
    params.threads = default_threads();
    add_search_flags(app, params);
    NetworkFlags network;
    add_network_flags(app, network);
    std::string rules = "chinese";
    bool manual = false;
    app.add_option("--name", settings.name, "what the engine calls itself")->capture_default_str();
    app.add_option("--size", settings.size, "of the board at the start")
        ->check(CLI::Range(go::min_size, go::max_size))
        ->capture_default_str();
    app.add_option("--komi", settings.komi, "at the start")->capture_default_str();
    app.add_option("--rules", rules, "by name or as JSON")->capture_default_str();
    app.add_option("--time", settings.seconds, "seconds a move when no clock is set")
        ->check(CLI::Range(0.001, 1e6))
        ->capture_default_str();
    app.add_option("--simulations", settings.simulations, "a move; 0: as time allows")
        ->capture_default_str();
    app.add_option("--visits", settings.visits, "a move, earlier ones counted; 0: as time allows")
        ->capture_default_str();
    app.add_option("--resign", settings.resign_below, "winrate at which to resign; 0: never")
        ->check(CLI::Range(0.0, 0.5))
        ->capture_default_str();
    app.add_flag("--ponder", settings.ponder, "think on the opponent's time");
    app.add_flag("--commands", manual, "print the table of commands and end");
    if (const auto status = parse_flags(app, arguments)) return *status;
    if (manual) return fmt::print("{}", Gtp::manual()), 0;
    settings.rules = go::rules_from_text(rules);
    choose_weights(network, params, "go");
    check_method(params, network);
    settings.weights = network.weights;
    settings.precision = network.precision;
    end_on_signals();
    Output output(std::cout);
    Gtp gtp(settings, params, output);
    if (gtp.handle(first_line)) gtp.serve(std::cin);
    // The reading thread may sit in a read that never ends: leave without waiting for it.
    std::fflush(stdout);
    std::quick_exit(0);
}

}  // namespace protocols
