// `sanban train`: from random weights and the rules to a network that plays, in one folder.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>

#include "engine/base/error.h"
#include "engine/games.h"
#include "protocols/commands.h"
#include "protocols/flags.h"
#include "protocols/learn_stage.h"
#include "protocols/setting_flags.h"
#include "protocols/stop_on_signal.h"
#include "selfplay/training/run.h"

namespace protocols {

namespace {

using selfplay::training::Bounds;
using selfplay::training::Settings;

struct TrainFlags {
    std::filesystem::path folder, from;
    std::optional<std::string> game, preset;
    Bounds bounds;
    int threads = default_threads(), nice = 0;
    SettingTexts settings;
};

void add_run_flags(CLI::App& app, TrainFlags& input) {
    app.add_option("--game", input.game, "go (unless said otherwise), chess or shogi");
    app.add_option("--dir", input.folder, "folder of the run; one that is there is gone on with")
        ->required();
    app.add_option("--preset", input.preset,
                   "what all settings begin as: laptop (unless said otherwise), alphazero, "
                   "alphagozero; alphago has flags of its own: --preset alphago --help");
    app.add_option("--from", input.from,
                   "network that a new run begins with instead of random weights");
    app.add_option("--minutes", input.bounds.minutes, "end after so many of them");
    app.add_option("--games", input.bounds.games, "end when so many have been played in all");
    app.add_option("--threads", input.threads, "processors to use")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    app.add_option("--nice", input.nice, "let other programs go first: 0..19")
        ->check(CLI::Range(0, 19))
        ->capture_default_str();
}

void be_nice(int nice) {
    errno = 0;
    if (nice > 0 && ::nice(nice) == -1 && errno != 0)
        engine::fail("--nice {} is not allowed here", nice);
}

Settings settings_of(const TrainFlags& input) {
    auto wanted = wanted_of(input.settings);
    wanted.game = input.game;
    wanted.preset = input.preset;
    wanted.taught = !input.from.empty();
    return selfplay::training::settings_for(input.folder, wanted);
}

template <engine::Encoded G>
void train(const TrainFlags& input, const Settings& settings) {
    const StopOnSignal signals;
    selfplay::training::Run<G> run(
        input.folder, settings, input.from, input.threads, input.bounds,
        [](const std::string& line) { fmt::print(stderr, "{}\n", line); });
    run.run(signals.token());
}

}  // namespace

int run_train(Arguments arguments) {
    if (const auto status = run_alphago_training(arguments)) return *status;
    CLI::App app(
        "Learns a game from random weights and its rules, until stopped; the newest "
        "network is DIR/latest.safetensors",
        "sanban train");
    TrainFlags input;
    add_run_flags(app, input);
    add_setting_flags(app, input.settings);
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
