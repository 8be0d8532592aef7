// What subcommands do with their flags: parsing, and the rows of search::SearchParams as flags.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "protocols/commands.h"
#include "search/network.h"
#include "search/params.h"

namespace protocols {

// A bad value fails with engine::Error when the line is parsed. `params` must outlive `app`.
void add_search_flags(CLI::App& app, search::SearchParams& params);

// Where weights come from and in what precision they run.
struct NetworkFlags {
    std::string weights;  // empty: none
    search::PrecisionChoice precision;
};

// `flags` must outlive `app`.
void add_network_flags(CLI::App& app, NetworkFlags& flags);
// Fails when the search that was asked for needs a network and none was named.
void check_method(const search::SearchParams& params, const NetworkFlags& flags);

// Parses what stands behind the subcommand's name; an exit status when that was all there is to do
// (--help, wrong usage).
std::optional<int> parse_flags(CLI::App& app, Arguments arguments);

// As many workers as the process may use processors.
int default_threads();

}  // namespace protocols
