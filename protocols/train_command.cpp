// `sanban train`: from random weights and the rules to a network that plays, in one folder.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "engine/base/error.h"
#include "engine/games.h"
#include "protocols/commands.h"
#include "protocols/flags.h"
#include "protocols/stop_on_signal.h"
#include "selfplay/training/run.h"

namespace protocols {

namespace {

using selfplay::training::Bounds;
using selfplay::training::Settings;
using selfplay::training::Wanted;

struct Input {
    std::filesystem::path folder;
    Wanted wanted;
    std::optional<std::string> file;
    Bounds bounds;
    int threads = default_threads(), nice = 0;
    std::map<std::string, std::string> changes;
};

void add_run_flags(CLI::App& app, Input& input) {
    app.add_option("--game", input.wanted.game, "go (unless said otherwise), chess or shogi");
    app.add_option("--dir", input.folder, "folder of the run; one that is there is gone on with")
        ->required();
    app.add_option("--preset", input.wanted.preset,
                   "what all settings begin as: laptop (unless said otherwise), alphazero, "
                   "alphagozero");
    app.add_option("--minutes", input.bounds.minutes, "end after so many of them");
    app.add_option("--games", input.bounds.games, "end when so many have been played in all");
    app.add_option("--threads", input.threads, "processors to use")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    app.add_option("--nice", input.nice, "let other programs go first: 0..19")
        ->check(CLI::Range(0, 19))
        ->capture_default_str();
}

// A flag for every setting of every table.
void add_settings(CLI::App& app, Input& input) {
    for (const auto& row : selfplay::training::setting_rows(Settings())) {
        const std::string name(row.name);
        std::string help(row.help);
        if (!row.least.empty()) help += " (" + row.least + ".." + row.most + ")";
        app.add_option("--" + name, input.changes[name], help)
            ->default_str(row.value)
            ->group("Settings, kept in DIR/settings.json; defaults are laptop's");
    }
}

void be_nice(int nice) {
    errno = 0;
    if (nice > 0 && ::nice(nice) == -1 && errno != 0)
        engine::fail("--nice {} is not allowed here", nice);
}

Settings settings_of(Input& input) {
    auto& wanted = input.wanted;
    for (const auto& [name, text] : input.changes)
        if (!text.empty()) wanted.changes.emplace_back(name, text);
    if (const auto& size = input.changes["size"]; !size.empty())
        wanted.size = engine::parse_number<int>(size);
    return selfplay::training::settings_for(input.folder, wanted);
}

template <engine::Encoded G>
void train(const Input& input, const Settings& settings) {
    const StopOnSignal signals;
    selfplay::training::Run<G> run(
        input.folder, settings, input.threads, input.bounds,
        [](const std::string& line) { fmt::print(stderr, "{}\n", line); });
    run.run(signals.token());
}

}  // namespace

int run_train(Arguments arguments) {
    CLI::App app(
        "Learns a game from random weights and its rules, until stopped; the newest "
        "network is DIR/latest.safetensors",
        "sanban train");
    Input input;
    add_run_flags(app, input);
    add_settings(app, input);
    if (const auto status = parse_flags(app, arguments)) return *status;
    const auto settings = settings_of(input);
    be_nice(input.nice);
    engine::Games::visit(settings.game, [&]<class G>() {
        train<G>(input, settings);
        return true;
    });
    return 0;
}

}  // namespace protocols
