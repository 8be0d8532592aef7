// `sanban learn`: from recorded games to weights, without playing.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "engine/games.h"
#include "protocols/commands.h"
#include "protocols/flags.h"
#include "protocols/learn_stage.h"
#include "protocols/setting_flags.h"
#include "protocols/stop_on_signal.h"
#include "selfplay/training/lecture.h"

namespace protocols {

namespace {

struct LearnFlags {
    selfplay::training::LectureInput lecture;
    std::optional<std::string> game, preset;
    SettingTexts settings;
};

void add_flags(CLI::App& app, LearnFlags& input) {
    auto& lecture = input.lecture;
    lecture.threads = default_threads();
    app.add_option("RECORDS", lecture.records, "files of self-play games, or folders of them")
        ->required();
    app.add_option("--out", lecture.out, "file of the weights to write")->required();
    app.add_option("--weights", lecture.weights, "weights to go on from; random ones unless given");
    app.add_option("--steps", lecture.steps, "of learning")
        ->check(CLI::Range(1, 100'000'000))
        ->capture_default_str();
    app.add_option("--threads", lecture.threads, "processors to use")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    app.add_option("--game", input.game, "go (unless said otherwise), chess or shogi");
    app.add_option("--preset", input.preset, "what all settings begin as");
    add_setting_flags(app, input.settings);
}

}  // namespace

int run_learn(Arguments arguments) {
    if (const auto status = run_learn_stage(arguments)) return *status;
    CLI::App app(
        "Learns from recorded games and writes a network; nothing is played. The stages of "
        "AlphaGo's training have flags of their own: sanban learn rollout --help",
        "sanban learn");
    LearnFlags input;
    add_flags(app, input);
    if (const auto status = parse_flags(app, arguments)) return *status;
    auto wanted = wanted_of(input.settings);
    wanted.game = input.game;
    wanted.preset = input.preset;
    const auto settings = selfplay::training::settings_for({}, wanted);
    const StopOnSignal signals;
    engine::Games::visit(settings.game, [&]<class G>() {
        selfplay::training::Lecture<G>(input.lecture, settings, [](const std::string& line) {
            fmt::print(stderr, "{}\n", line);
        }).run(signals.token());
        return true;
    });
    return 0;
}

}  // namespace protocols
