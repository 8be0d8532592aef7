#include "protocols/flags.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <thread>

#include "search/embedded_weights.h"

namespace protocols {

std::string help_of(const engine::OptionRow& row) {
    if (row.least.empty()) return std::string(row.help);
    return fmt::format("{} ({}..{})", row.help, row.least, row.most);
}

void add_search_flags(CLI::App& app, search::SearchParams& params) {
    add_settings_flags(app, params, "Options");
}

void add_network_flags(CLI::App& app, NetworkFlags& flags) {
    app.add_option("--weights", flags.weights,
                   "network of sanban, KataGo, lc0 or Leela Zero; a bare name is looked for beside "
                   "the executable, in the working folder and in the data folder; none: UCT. "
                   "Unless given the network that this program carries, if any");
    app.add_option_function<std::string>(
           "--precision",
           [&flags](const std::string& text) { flags.precision = search::precision_choice(text); },
           fmt::format("in which the network is run: {}; auto: the fastest that loses nothing play "
                       "would notice",
                       fmt::join(search::precision_choices(), ", ")))
        ->default_str("auto");
}

void choose_weights(NetworkFlags& flags, const search::SearchParams& params,
                    std::string_view game) {
    if (flags.weights == "none") return flags.weights.clear();
    if (!flags.weights.empty() || params.method == search::Method::uct) return;
    if (search::embedded_weights(game).empty())
        fmt::print(stderr, "sanban carries no network for {}: games are played out (UCT)\n", game);
    else
        flags.weights = search::embedded_name;
}

void check_method(const search::SearchParams& params, const NetworkFlags& flags) {
    const bool needs_network =
        params.method != search::Method::automatic && params.method != search::Method::uct;
    if (needs_network && flags.weights.empty())
        engine::fail("--search {} needs a network: --weights FILE",
                     search::method_names[static_cast<std::size_t>(params.method)]);
}

std::optional<int> parse_flags(CLI::App& app, Arguments arguments) {
    try {
        // CLI11 passes over the first word, which here is the subcommand's name.
        app.parse(static_cast<int>(arguments.size()) + 1, arguments.data() - 1);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    return std::nullopt;
}

int default_threads() {
    return static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 1024u));
}

}  // namespace protocols
