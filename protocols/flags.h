// What subcommands do with their flags: parsing, and the rows of search::SearchParams as flags.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>

#include "protocols/commands.h"
#include "search/params.h"

namespace protocols {

// A bad value fails with engine::Error when the line is parsed. `params` must outlive `app`.
void add_search_flags(CLI::App& app, search::SearchParams& params);

// Parses what stands behind the subcommand's name; an exit status when that was all there is to do
// (--help, wrong usage).
std::optional<int> parse_flags(CLI::App& app, Arguments arguments);

// As many workers as the process may use processors.
int default_threads();

}  // namespace protocols
