#include "selfplay/alphago/rl_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "engine/base/error.h"
#include "nn/load.h"
#include "selfplay/alphago/policy_games.h"
#include "selfplay/alphago/policy_stage.h"
#include "selfplay/training/batch.h"
#include "selfplay/training/student.h"

namespace selfplay::alphago {

namespace {

namespace fs = std::filesystem;

training::LearnSettings learning(const RlSettings& settings) {
    training::LearnSettings learn;
    learn.optimiser = nn::training::Method::sgd;
    learn.momentum = 0;
    learn.weight_decay = 0;
    learn.warm_up = 0;
    learn.average = 0;
    learn.rate = settings.rate;
    learn.most_norm = settings.most_norm;
    learn.micro_batch = settings.micro_batch;
    return learn;
}

class RlStage {
   public:
    RlStage(const StageInput& input, const fs::path& policy, const fs::path& baseline,
            const RlSettings& settings, const std::stop_token& stop)
        : input_(input),
          settings_(settings),
          first_(policy_to_go_on_from(policy)),
          folder_(input.folder),
          state_(folder_.state()),
          student_(first_, learning(settings), input.threads, folder_, input.say),
          workers_(input.threads),
          random_(engine::mixed(static_cast<std::uint64_t>(settings.seed),
                                static_cast<std::uint64_t>(student_.steps()))),
          watch_(input, stop) {
        fs::create_directories(folder_.snapshots());
        if (pool().empty()) nn::save(first_, snapshot(0));
        if (!baseline.empty())
            baseline_.emplace(
                std::make_shared<const search::Network>(nn::load(baseline), nn::Precision::bf16));
    }

    void run() {
        while (!watch_.over() && !done()) {
            update();
            if (student_.steps() % settings_.snapshot_updates == 0) take_snapshot();
        }
        keep();
    }

   private:
    int size() const { return first_.facts.board; }
    bool done() const { return settings_.updates > 0 && student_.steps() >= settings_.updates; }

    fs::path snapshot(std::int64_t step) const {
        return folder_.snapshots() / fmt::format("{:08}.safetensors", step);
    }
    std::vector<fs::path> pool() const {
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(folder_.snapshots()))
            if (entry.path().extension() == ".safetensors") files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        return files;
    }

    // The student has Black in every second game.
    static bool is_black(const Playing& playing) { return playing.number % 2 == 0; }
    static bool is_students(const Playing& playing) {
        return (playing.game.to_play() == engine::Player::first) == is_black(playing);
    }
    std::vector<Playing> play(int games, std::shared_ptr<const search::Network> opponent) {
        const Networks networks{playing_network(student_.newest()), std::move(opponent)};
        const Plan plan{[](const Playing& playing) { return is_students(playing) ? 0 : 1; },
                        is_students};
        return play_games(games, size(), random_(), networks, plan, workers_);
    }
    static float students_result(const Playing& playing) {
        return result_for(playing.record,
                          is_black(playing) ? engine::Player::first : engine::Player::second);
    }
    static double score(std::span<const Playing> games) {
        double score = 0;
        for (const auto& playing : games) score += (1 + double{students_result(playing)}) / 2;
        return score / static_cast<double>(games.size());
    }

    void update() {
        const auto files = pool();
        const auto& drawn =
            files[static_cast<std::size_t>(random_.below(static_cast<int>(files.size())))];
        const auto games = play(settings_.games, playing_network(nn::load(drawn)));
        learn(games);
        const nlohmann::ordered_json line{{"stage", "rl"},
                                          {"minutes", (state_.seconds + watch_.seconds()) / 60},
                                          {"update", student_.steps()},
                                          {"opponent", drawn.stem().string()},
                                          {"games", games.size()},
                                          {"score", score(games)},
                                          {"plies", plies(games)}};
        tell(input_, journal(), line.dump());
    }

    static double plies(std::span<const Playing> games) {
        double sum = 0;
        for (const auto& playing : games) sum += static_cast<double>(playing.record.turns.size());
        return sum / static_cast<double>(games.size());
    }

    void learn(std::span<const Playing> games) {
        const auto& encoding = engine::find_encoding<go::Go>(first_.facts.encoding);
        const auto means = mean_results(games);
        std::vector<training::Lesson> lessons;
        for (const auto& playing : games)
            for (std::size_t turn = 0; turn < playing.record.turns.size(); ++turn) {
                if (playing.record.turns[turn].share_count == 0) continue;
                auto& lesson = lessons.emplace_back();
                training::write_lesson(playing.record, turn, encoding, 0, {}, lesson);
                const auto game = training::position_of<go::Go>(playing.record, turn);
                keep_sensible(game, lesson);
                lesson.policy_weight = students_result(playing) -
                                       (baseline_ ? expected(game) : means[is_black(playing)]);
            }
        training::Batch batch;
        batch.fill(lessons, size(), student_.terms());
        student_.learn(batch.samples());
        student_.take_quality();
    }

    // Of the student's games as White and as Black. Without a baseline a student
    // that wins three games of four is told to do more of nearly all it does, and goes astray.
    static std::array<float, 2> mean_results(std::span<const Playing> games) {
        std::array<float, 2> sums{}, counts{};
        for (const auto& playing : games) {
            sums[is_black(playing)] += students_result(playing);
            ++counts[is_black(playing)];
        }
        return {sums[0] / std::max(counts[0], 1.0f), sums[1] / std::max(counts[1], 1.0f)};
    }

    // What the baseline says of the position, as the student sees it.
    float expected(const go::Go& game) {
        const engine::MoveList none;
        search::Evaluation answer;
        const search::Query<go::Go> query{&game, &none, 0, &answer};
        baseline_->evaluate({&query, 1});
        return answer.value();
    }

    void take_snapshot() {
        nn::save(student_.newest(), snapshot(student_.steps()));
        keep();
        if (settings_.judge_games == 0) return;
        const auto games = play(settings_.judge_games, playing_network(first_));
        const nlohmann::ordered_json line{{"stage", "rl"},
                                          {"minutes", (state_.seconds + watch_.seconds()) / 60},
                                          {"update", student_.steps()},
                                          {"opponent", "first"},
                                          {"games", games.size()},
                                          {"score_against_first", score(games)}};
        tell(input_, journal(), line.dump());
    }

    void keep() {
        student_.save();
        nn::save(student_.newest(), folder_.latest());
        auto now = state_;
        now.seconds += watch_.seconds();
        folder_.keep(now);
    }

    fs::path journal() const { return input_.folder / "rl.jsonl"; }

    const StageInput& input_;
    const RlSettings& settings_;
    nn::Graph first_;
    training::RunFolder folder_;
    training::RunState state_;  // before this call
    training::Student student_;
    nn::training::Workers workers_;
    engine::Random random_;
    Watch watch_;
    std::optional<search::NetworkEvaluator<go::Go>> baseline_;
};

}  // namespace

void keep_sensible(const go::Go& game, training::Lesson& lesson) {
    const auto sensible = search::PolicyPlayer<go::Go>::sensible(game);
    std::size_t from = 0, kept = 0;
    for (const auto move : game.legal_moves()) {
        if (sensible.contains(move)) {
            lesson.moves[kept] = lesson.moves[from];
            lesson.policy[kept++] = lesson.policy[from];
        }
        ++from;
    }
    lesson.moves.resize(kept);
    lesson.policy.resize(kept);
}

void learn_rl(const StageInput& input, const fs::path& policy, const fs::path& baseline,
              const RlSettings& settings, const std::stop_token& stop) {
    RlStage(input, policy, baseline, settings, stop).run();
}

}  // namespace selfplay::alphago
