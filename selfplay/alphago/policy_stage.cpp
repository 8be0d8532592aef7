#include "selfplay/alphago/policy_stage.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/base/error.h"
#include "nn/load.h"
#include "nn/passes.h"
#include "selfplay/alphago/expert_games.h"
#include "selfplay/training/student.h"

namespace selfplay::alphago {

namespace {

class PolicyStage {
   public:
    PolicyStage(const StageInput& input, nn::Graph fresh, const PolicySettings& settings,
                const training::LearnSettings& learning, const std::stop_token& stop)
        : input_(input),
          settings_(settings),
          learning_(learning),
          folder_(input.folder),
          state_(folder_.state()),
          facts_(fresh.facts),
          games_(read_expert_games(
              input.records, {facts_.board, settings.least_moves, settings.games}, input.say)),
          lessons_(games_.lessons),
          held_out_(games_.held_out),
          batches_(facts_.encoding, input.threads),
          student_(begin(std::move(fresh)), learning, input.threads, folder_, input.say),
          random_(engine::mixed(static_cast<std::uint64_t>(settings.seed),
                                static_cast<std::uint64_t>(student_.steps()))),
          watch_(input, stop) {}

    void run() {
        double reported = 0;
        while (!watch_.over() && !done()) {
            learn();
            if (watch_.seconds() < reported + settings_.report_seconds) continue;
            report();
            reported = watch_.seconds();
        }
        report();
    }

   private:
    nn::Graph begin(nn::Graph fresh) {
        if (!settings_.norms) return fresh;
        engine::Random random(static_cast<std::uint64_t>(settings_.seed));
        return with_norms(
            fresh, folder_, learning_, input_.threads,
            [&](auto terms) -> const nn::training::Samples& { return draw(random, terms); });
    }

    bool done() const { return settings_.steps > 0 && student_.steps() >= settings_.steps; }

    void learn() { student_.learn(draw(random_, student_.terms())); }

    // Always the same positions, spread over all that are held out, seen as they stand.
    training::Quality judge() {
        training::QualityTally tally;
        const auto all = static_cast<std::uint64_t>(settings_.judged);
        const auto part = static_cast<std::uint64_t>(learning_.batch);
        for (std::uint64_t from = 0; from < all; from += part) {
            places_.clear();
            for (auto i = from; i < std::min(from + part, all); ++i)
                places_.push_back(held_out_[held_out_.count() * i / all]);
            turns_.assign(places_.size(), 0);
            const auto& samples = batches_.make(places_, turns_, student_.terms());
            tally.add(student_.judge(samples), student_.terms(), samples.size);
        }
        return tally.mean();
    }

    void report() {
        student_.save();
        nn::save(nn::fold_batch_norms(student_.playable(draw(random_, student_.terms()))),
                 folder_.latest());
        const auto learned = student_.take_quality();
        const auto held_out = judge();
        auto now = state_;
        now.seconds += watch_.seconds();
        folder_.keep(now);
        const nlohmann::ordered_json line{{"stage", "policy"},
                                          {"minutes", now.seconds / 60},
                                          {"steps", student_.steps()},
                                          {"samples", student_.steps() * learning_.batch},
                                          {"loss", learned.policy_loss},
                                          {"accuracy", learned.policy_accuracy},
                                          {"held_out_loss", held_out.policy_loss},
                                          {"held_out_accuracy", held_out.policy_accuracy}};
        tell(input_, input_.folder / "policy.jsonl", line.dump());
    }

    const nn::training::Samples& draw(engine::Random& random,
                                      std::span<const nn::training::Term> terms) {
        constexpr int symmetries = 8;
        places_.clear();
        turns_.clear();
        for (int i = 0; i < learning_.batch; ++i) {
            places_.push_back(lessons_.draw(random));
            turns_.push_back(random.below(symmetries));
        }
        return batches_.make(places_, turns_, terms);
    }

    const StageInput& input_;
    const PolicySettings& settings_;
    const training::LearnSettings& learning_;
    training::RunFolder folder_;
    training::RunState state_;  // before this call
    nn::Facts facts_;
    ExpertGames games_;
    ExpertPositions lessons_, held_out_;
    ExpertBatches batches_;
    std::vector<ExpertPlace> places_;
    std::vector<int> turns_;
    training::Student student_;
    engine::Random random_;
    Watch watch_;
};

}  // namespace

training::LearnSettings policy_learning() {
    training::LearnSettings learning;
    learning.batch = 128;
    learning.micro_batch = 64;
    learning.optimiser = nn::training::Method::adamw;
    learning.rate = 1e-3f;
    learning.warm_up = 200;
    learning.weight_decay = 1e-4f;
    learning.most_norm = 5;
    learning.average = 0.999f;
    return learning;
}

nn::Graph policy_to_go_on_from(const std::filesystem::path& file) {
    auto graph = nn::load(file);
    if (graph.facts.game != go::Go::name || !graph.output("policy") || graph.facts.board == 0)
        engine::fail("{}: expected a policy network of Go on one board", file.string());
    graph.facts.steps = 0;
    return graph;
}

void learn_policy(const StageInput& input, nn::Graph fresh, const PolicySettings& settings,
                  const training::LearnSettings& learning, const std::stop_token& stop) {
    PolicyStage(input, std::move(fresh), settings, learning, stop).run();
}

}  // namespace selfplay::alphago
