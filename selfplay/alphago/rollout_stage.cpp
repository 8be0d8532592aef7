#include "selfplay/alphago/rollout_stage.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "selfplay/alphago/expert_games.h"
#include "selfplay/alphago/linear_learner.h"
#include "selfplay/training/folder.h"

namespace selfplay::alphago {

namespace {

class RolloutStage {
   public:
    RolloutStage(const StageInput& input, const RolloutSettings& settings,
                 const std::stop_token& stop)
        : input_(input),
          settings_(settings),
          folder_(input.folder),
          games_(read_expert_games(
              input.records, {settings.size, settings.least_moves, settings.games}, input.say)),
          watch_(input, stop) {
        if (std::filesystem::exists(file())) learner_.restore(file());
    }

    void run() {
        engine::Random random(static_cast<std::uint64_t>(settings_.seed) + learner_.steps());
        double reported = watch_.seconds();
        while (!watch_.over() && !done()) {
            const auto number = random.below(static_cast<int>(games_.lessons.size()));
            learn(games_.lessons[static_cast<std::size_t>(number)]);
            if (watch_.seconds() < reported + settings_.report_seconds) continue;
            reported = watch_.seconds();
            report();
        }
        report();
    }

   private:
    std::filesystem::path file() const { return input_.folder / "rollout.safetensors"; }
    bool done() const {
        return learner_.steps() >= static_cast<std::uint64_t>(settings_.positions);
    }

    void learn(const ExpertGame& expert) {
        go::Go game = start_of(expert);
        for (const auto code : expert.moves) {
            learner_.learn(game, {code}, settings_.rate);
            game.play({code});
        }
    }

    void report() {
        judge();
        learner_.save(file());
        const auto quality = learner_.take_quality();
        const nlohmann::ordered_json line{{"stage", "rollout"},
                                          {"minutes", watch_.seconds() / 60},
                                          {"positions", learner_.steps()},
                                          {"rollout_accuracy", quality[0].accuracy},
                                          {"rollout_loss", quality[0].loss},
                                          {"tree_accuracy", quality[1].accuracy},
                                          {"tree_loss", quality[1].loss}};
        tell(input_, input_.folder / "rollout.jsonl", line.dump());
    }

    // All positions of as many games as make up the number.
    void judge() {
        std::size_t judged = 0;
        for (const auto& expert : games_.held_out) {
            if (judged >= static_cast<std::size_t>(settings_.judged)) break;
            judged += expert.moves.size();
            go::Go game = start_of(expert);
            for (const auto code : expert.moves) {
                learner_.judge(game, {code});
                game.play({code});
            }
        }
    }

    const StageInput& input_;
    const RolloutSettings& settings_;
    training::RunFolder folder_;
    ExpertGames games_;
    LinearLearner learner_;
    Watch watch_;
};

}  // namespace

void learn_rollout(const StageInput& input, const RolloutSettings& settings,
                   const std::stop_token& stop) {
    RolloutStage(input, settings, stop).run();
}

}  // namespace selfplay::alphago
