#include "selfplay/training/learn_settings.h"

#include "engine/base/error.h"

namespace selfplay::training {

namespace {

nn::training::Schedule schedule(const LearnSettings& settings) {
    nn::training::Schedule schedule;
    schedule.rate = settings.rate;
    schedule.warm_up = settings.warm_up;
    float rate = settings.rate;
    for (const int step : {settings.first_drop, settings.second_drop, settings.third_drop}) {
        if (step == 0) continue;
        if (!schedule.drops.empty() && schedule.drops.back().first >= step)
            engine::fail("first-drop, second-drop and third-drop must rise: {} is not after {}",
                         step, schedule.drops.back().first);
        rate *= settings.drop_factor;
        schedule.drops.emplace_back(step, rate);
    }
    return schedule;
}

nn::Precision precision_of(Numbers numbers) {
    if (numbers == Numbers::fastest) return nn::training::faster_precision();
    return numbers == Numbers::bf16 ? nn::Precision::bf16 : nn::Precision::fp32;
}

float weight_of(const LearnSettings& settings, const nn::training::Term& term) {
    using nn::training::Loss;
    if (term.loss == Loss::distribution || term.loss == Loss::square) return settings.value_weight;
    if (term.loss == Loss::ownership) return settings.ownership_weight;
    return term.loss == Loss::score ? settings.score_weight : term.weight;
}

}  // namespace

nn::training::LearnerSettings learner_settings(const LearnSettings& settings,
                                               const nn::Graph& graph, int threads) {
    nn::training::LearnerSettings learner;
    learner.optimiser.method = settings.optimiser;
    learner.optimiser.schedule = schedule(settings);
    learner.optimiser.momentum = settings.momentum;
    learner.optimiser.weight_decay = settings.weight_decay;
    learner.optimiser.most_norm = settings.most_norm;
    if (settings.optimiser == nn::training::Method::adamw)
        learner.optimiser.decay = nn::training::Decay::decoupled;
    learner.terms = nn::training::usual_terms(graph);
    for (auto& term : learner.terms) term.weight = weight_of(settings, term);
    learner.precision = precision_of(settings.numbers);
    learner.threads = threads;
    learner.micro_batch = settings.micro_batch;
    learner.average = settings.average;
    return learner;
}

}  // namespace selfplay::training
