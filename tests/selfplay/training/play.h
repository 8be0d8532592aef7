// Self-play in tests: networks whose answers are made up, and the games an actor plays with them.
#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "selfplay/training/actor.h"

namespace selfplay::training {

// Answers that a test makes up.
template <engine::Encoded G>
class Oracle final : public search::EvaluatorSource<G> {
   public:
    using Answer = std::function<void(const search::Query<G>&)>;
    explicit Oracle(Answer answer) : answer_(std::move(answer)) {}

    std::unique_ptr<search::Evaluator<G>> make_evaluator() const override {
        return std::make_unique<Own>(answer_);
    }
    std::string_view name() const override { return "oracle"; }
    void check(const G&) const override {}
    int policy_index(const G&, engine::Move) const override { return 0; }

   private:
    class Own final : public search::Evaluator<G> {
       public:
        explicit Own(const Answer& answer) : answer_(answer) {}
        void evaluate(std::span<const search::Query<G>> queries) override {
            for (const auto& query : queries) {
                auto& to = *query.answer;
                to = {};
                const auto count = static_cast<std::size_t>(query.moves->size());
                to.priors.assign(count, 1 / static_cast<float>(count));
                to.win = to.loss = 0.5f;
                answer_(query);
            }
        }
        int symmetries(const G&) const override { return 1; }
        std::uint64_t key(const G& game) const override { return game.key(); }

       private:
        Answer answer_;
    };
    Answer answer_;
};

template <class G>
typename Actor<G>::Source even() {
    return std::make_shared<Oracle<G>>([](const search::Query<G>&) {});
}

template <class G>
std::vector<records::Game> games_of(const ActorSettings& settings, std::uint64_t seed,
                                    typename Actor<G>::Source network, std::uint64_t count) {
    std::vector<records::Game> games;
    Actor<G> actor(
        settings, seed, std::move(network), 7,
        [&](records::Game game) { games.push_back(std::move(game)); }, count);
    while (actor.advance()) {
    }
    return games;
}

inline ActorSettings small_settings() {
    ActorSettings settings;
    settings.games = 5;
    settings.batch = 3;
    settings.simulations = 8;
    settings.fast_simulations = 3;
    settings.size = 5;
    settings.move_limit = 60;
    return settings;
}

}  // namespace selfplay::training
