// What subcommands do with their flags: parsing, and the rows of search::SearchParams as flags.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "engine/base/option.h"
#include "protocols/commands.h"
#include "search/network.h"
#include "search/params.h"

namespace protocols {

// What --help says of a row: its help and its range.
std::string help_of(const engine::OptionRow& row);

// A flag for each row of the options of `settings`, which must outlive `app`; under the heading
// `group` in the help. A bad value fails with engine::Error when the line is parsed.
template <class Settings>
void add_settings_flags(CLI::App& app, Settings& settings, const std::string& group) {
    for (const auto& row : engine::option_rows(settings)) {
        const std::string name(row.name);
        app.add_option_function<std::string>(
               "--" + name,
               [&settings, name](const std::string& text) {
                   engine::set_option(settings, name, text);
               },
               help_of(row))
            ->default_str(row.value)
            ->group(group);
    }
}

// Likewise, among the other flags.
void add_search_flags(CLI::App& app, search::SearchParams& params);

// Where weights come from and in what precision they run.
struct NetworkFlags {
    std::string weights;  // a file, "none", or empty: what this program carries
    search::PrecisionChoice precision;
};

// `flags` must outlive `app`.
void add_network_flags(CLI::App& app, NetworkFlags& flags);
// Before a game: without --weights the network that this program carries for it, where there is one
// and the search can use it; says so on stderr where there is none. What was "none" is empty then.
void choose_weights(NetworkFlags& flags, const search::SearchParams& params, std::string_view game);
// Fails when the search that was asked for needs a network and none was named.
void check_method(const search::SearchParams& params, const NetworkFlags& flags);

// Parses what stands behind the subcommand's name; an exit status when that was all there is to do
// (--help, wrong usage).
std::optional<int> parse_flags(CLI::App& app, Arguments arguments);

// As many workers as the process may use processors.
int default_threads();

}  // namespace protocols
