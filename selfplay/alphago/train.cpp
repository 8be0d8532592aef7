#include "selfplay/alphago/train.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "engine/base/files.h"
#include "selfplay/alphago/report.h"

namespace selfplay::alphago {

namespace {

namespace fs = std::filesystem;

class Training {
   public:
    Training(const StageInput& input, const StageNetwork& network, const TrainSettings& settings,
             const std::stop_token& stop)
        : input_(input), network_(network), settings_(settings), stop_(stop), watch_(input, stop) {
        fs::create_directories(weights());
        input_.report = [this, tell = input.report](const std::string& line) {
            tell(line);
            if (watch_.seconds() < published_ + seconds_between_reports) return;
            publish();
        };
    }

    void run() {
        finish("rollout", "rollout.safetensors", [&](const StageInput& stage) { rollout(stage); });
        finish("policy", "latest.safetensors", [&](const StageInput& stage) { policy(stage); });
        finish("rl", "latest.safetensors", [&](const StageInput& stage) { rl(stage); });
        finish("value", "latest.safetensors", [&](const StageInput& stage) { value(stage); });
        publish();
    }

   private:
    static constexpr double seconds_between_reports = 20;

    fs::path weights() const { return input_.folder / "weights"; }
    fs::path finished(const std::string& stage) const {
        return weights() / (stage + ".safetensors");
    }

    // Runs the stage for what is left of the time, unless it was finished before.
    template <class Learn>
    void finish(const std::string& name, const char* result, Learn learn) {
        if (fs::exists(finished(name)) || watch_.over()) return;
        auto stage = input_;
        stage.folder = input_.folder / name;
        if (input_.minutes) stage.minutes = *input_.minutes - watch_.seconds() / 60;
        input_.say(fmt::format("stage {}", name));
        learn(stage);
        if (!watch_.over())
            fs::copy_file(stage.folder / result, finished(name),
                          fs::copy_options::overwrite_existing);
    }

    void publish() {
        published_ = watch_.seconds();
        auto rows = engine::option_rows(network_);
        std::ranges::copy(engine::option_rows(settings_), std::back_inserter(rows));
        const auto title = fmt::format("AlphaGo on {0}x{0}: policy of {1} layers of {2} filters",
                                       network_.size, network_.layers, network_.filters);
        engine::write_file(input_.folder / "report.html", report_html(input_.folder, title, rows));
    }

    void rollout(const StageInput& stage) const {
        RolloutSettings settings;
        settings.seed = settings_.seed;
        settings.size = network_.size;
        settings.games = settings_.games;
        settings.positions = settings_.rollout_positions;
        learn_rollout(stage, settings, stop_);
    }
    void policy(const StageInput& stage) const {
        PolicySettings settings;
        settings.seed = settings_.seed;
        settings.games = settings_.games;
        settings.steps = settings_.policy_steps;
        learn_policy(stage, new_policy(network_, static_cast<std::uint64_t>(settings.seed)),
                     settings, policy_learning(), stop_);
    }
    void rl(const StageInput& stage) const {
        RlSettings settings;
        settings.seed = settings_.seed;
        settings.games = settings_.rl_games;
        settings.updates = settings_.rl_updates;
        settings.snapshot_updates = std::clamp(settings_.rl_updates / 10, 1, 500);
        learn_rl(stage, finished("policy"), {}, settings, stop_);
    }
    void value(const StageInput& stage) const {
        ValueSettings settings;
        settings.seed = settings_.seed;
        settings.games = settings_.value_games;
        settings.steps = settings_.value_steps;
        learn_value(stage, {finished("policy"), finished("rl")}, settings, policy_learning(),
                    stop_);
    }

    StageInput input_;
    const StageNetwork& network_;
    const TrainSettings& settings_;
    const std::stop_token& stop_;
    Watch watch_;
    double published_ = 0;  // when, in the call's seconds
};

}  // namespace

void train_alphago(const StageInput& input, const StageNetwork& network,
                   const TrainSettings& settings, const std::stop_token& stop) {
    Training(input, network, settings, stop).run();
}

}  // namespace selfplay::alphago
