#include "protocols/flags.h"

#include <algorithm>
#include <string>
#include <thread>

namespace protocols {

void add_search_flags(CLI::App& app, search::SearchParams& params) {
    for (const auto& row : engine::option_rows(params)) {
        const std::string name(row.name);
        std::string help(row.help);
        if (!row.least.empty()) help += " (" + row.least + ".." + row.most + ")";
        app.add_option_function<std::string>(
               "--" + name,
               [&params, name](const std::string& text) { engine::set_option(params, name, text); },
               help)
            ->default_str(row.value);
    }
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
