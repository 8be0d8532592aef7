// `sanban learn rollout`, `policy`, `rl` and `value`: the stages of AlphaGo's training, one by one;
// and all of them as `sanban train --preset alphago`.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include "protocols/commands.h"
#include "protocols/flags.h"
#include "protocols/learn_stage.h"
#include "protocols/stop_on_signal.h"
#include "selfplay/alphago/policy_stage.h"
#include "selfplay/alphago/rl_stage.h"
#include "selfplay/alphago/rollout_stage.h"
#include "selfplay/alphago/train.h"
#include "selfplay/alphago/value_stage.h"

namespace protocols {

namespace {

namespace alphago = selfplay::alphago;

void add_folder_flags(CLI::App& app, alphago::StageInput& input) {
    input.threads = default_threads();
    input.say = [](const std::string& line) { fmt::print(stderr, "{}\n", line); };
    input.report = [](const std::string& line) {
        fmt::print("{}\n", line);
        std::fflush(stdout);
    };
    app.add_option("--dir", input.folder, "folder of the stage; one that is there is gone on with")
        ->required();
    app.add_option("--minutes", input.minutes, "end after so many of them");
    app.add_option("--threads", input.threads, "processors to use")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
}

void add_record_flags(CLI::App& app, alphago::StageInput& input) {
    app.add_option("--records", input.records,
                   "SGF files, or folders of them; every tenth game is held out")
        ->required();
}

int learn_rollout(Arguments arguments) {
    CLI::App app("Learns AlphaGo's rollout and tree policies of Go from records of games",
                 "sanban learn rollout");
    alphago::StageInput input;
    alphago::RolloutSettings settings;
    add_folder_flags(app, input);
    add_record_flags(app, input);
    add_settings_flags(app, settings, "Settings");
    if (const auto status = parse_flags(app, arguments)) return *status;
    const StopOnSignal signals;
    alphago::learn_rollout(input, settings, signals.token());
    return 0;
}

int learn_policy(Arguments arguments) {
    CLI::App app("Learns AlphaGo's policy network of Go from records of games",
                 "sanban learn policy");
    alphago::StageInput input;
    alphago::StageNetwork network;
    alphago::PolicySettings settings;
    auto learning = alphago::policy_learning();
    std::string from;
    add_folder_flags(app, input);
    add_record_flags(app, input);
    app.add_option("--from", from,
                   "policy network that a new folder goes on from, in place of random weights");
    add_settings_flags(app, network, "Network");
    add_settings_flags(app, settings, "Settings");
    add_settings_flags(app, learning, "Learning");
    if (const auto status = parse_flags(app, arguments)) return *status;
    const StopOnSignal signals;
    auto fresh = from.empty()
                     ? alphago::new_policy(network, static_cast<std::uint64_t>(settings.seed))
                     : alphago::policy_to_go_on_from(from);
    alphago::learn_policy(input, std::move(fresh), settings, learning, signals.token());
    return 0;
}

int learn_rl(Arguments arguments) {
    CLI::App app("Improves AlphaGo's policy network of Go by games against its own past",
                 "sanban learn rl");
    alphago::StageInput input;
    alphago::RlSettings settings;
    std::string policy, baseline;
    add_folder_flags(app, input);
    app.add_option("--policy", policy, "network to begin with, as sanban learn policy makes it")
        ->required();
    app.add_option("--baseline", baseline, "value network that results are measured against");
    add_settings_flags(app, settings, "Settings");
    if (const auto status = parse_flags(app, arguments)) return *status;
    const StopOnSignal signals;
    alphago::learn_rl(input, policy, baseline, settings, signals.token());
    return 0;
}

int learn_value(Arguments arguments) {
    CLI::App app("Learns AlphaGo's value network of Go from games of its policies, or by others",
                 "sanban learn value");
    alphago::StageInput input;
    alphago::ValuePlayers players;
    alphago::ValueSettings settings;
    auto learning = alphago::policy_learning();
    add_folder_flags(app, input);
    app.add_option("--policy", players.policy,
                   "network that plays up to the drawn move; with --records the one whose layers "
                   "the value network begins with")
        ->required();
    auto* const rl = app.add_option("--rl", players.reinforced, "network that plays the rest");
    app.add_option("--records", input.records,
                   "in place of games that are played: SGF files, or folders of them; every "
                   "tenth game is held out")
        ->excludes(rl);
    add_settings_flags(app, settings, "Settings");
    add_settings_flags(app, learning, "Learning");
    if (const auto status = parse_flags(app, arguments)) return *status;
    if (input.records.empty() && players.reinforced.empty())
        engine::fail("expected --rl, the network that plays, or --records, games by others");
    const StopOnSignal signals;
    if (input.records.empty()) {
        alphago::learn_value(input, players, settings, learning, signals.token());
        return 0;
    }
    const auto fresh =
        alphago::value_upon(alphago::policy_to_go_on_from(players.policy),
                            static_cast<std::uint64_t>(settings.seed), settings.pooled);
    alphago::learn_value_from_records(input, fresh, settings, learning, signals.token());
    return 0;
}

}  // namespace

std::optional<int> run_learn_stage(Arguments arguments) {
    if (arguments.empty()) return {};
    const std::string_view stage = arguments[0];
    if (stage == "rollout") return learn_rollout(arguments.subspan(1));
    if (stage == "policy") return learn_policy(arguments.subspan(1));
    if (stage == "rl") return learn_rl(arguments.subspan(1));
    if (stage == "value") return learn_value(arguments.subspan(1));
    return {};
}

namespace {

bool wants_alphago(Arguments arguments) {
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string_view word = arguments[i];
        if (word == "--preset=alphago") return true;
        if (word == "--preset" && i + 1 < arguments.size())
            return std::string_view(arguments[i + 1]) == "alphago";
    }
    return false;
}

int train_alphago(Arguments arguments) {
    CLI::App app(
        "Learns Go as AlphaGo did, stage by stage, from records of games; the networks are "
        "DIR/weights",
        "sanban train --preset alphago");
    alphago::StageInput input;
    alphago::StageNetwork network;
    alphago::TrainSettings settings;
    std::string preset;
    app.add_option("--preset", preset, "alphago");
    add_folder_flags(app, input);
    add_record_flags(app, input);
    add_settings_flags(app, network, "Networks");
    add_settings_flags(app, settings, "Stages");
    if (const auto status = parse_flags(app, arguments)) return *status;
    const StopOnSignal signals;
    alphago::train_alphago(input, network, settings, signals.token());
    return 0;
}

}  // namespace

std::optional<int> run_alphago_training(Arguments arguments) {
    if (!wants_alphago(arguments)) return {};
    return train_alphago(arguments);
}

}  // namespace protocols
