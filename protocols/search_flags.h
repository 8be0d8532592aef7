// The flags that every subcommand with a search behind it takes: the rows of search::SearchParams.
#pragma once

#include <CLI/CLI.hpp>

#include "search/params.h"

namespace protocols {

// A bad value fails with engine::Error when the line is parsed. `params` must outlive `app`.
void add_search_flags(CLI::App& app, search::SearchParams& params);

// As many workers as the process may use processors.
int default_threads();

}  // namespace protocols
