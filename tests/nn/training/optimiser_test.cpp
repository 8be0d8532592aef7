#include "nn/training/optimiser.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nn/compose.h"

namespace nn::training {
namespace {

// One matrix of one number, one bias, and a batch norm.
Graph tiny() {
    Graph g;
    const int x = add_input(g, "globals", {1, false});
    const int y = add_dense(g, "dense", x, {{{1, 1}, {2}}, {{1}, {2}}});
    name_output(g, "value",
                add_batch_norm(g, "norm", y, {{{1}, {5}}, {{1}, {6}}, {{1}, {1}}, {{1}, {0}}}, 1));
    return g;
}

struct Trial {
    Graph graph = tiny();
    Parameters parameters{graph};
    std::vector<float> weights = parameters.read(graph);
    std::vector<float> gradients = {1, 1, 9, 9, 0, 0};

    // Upon a network that has had `before` steps.
    void run(const OptimiserSettings& settings, int steps, int before = 0) {
        Optimiser optimiser(parameters, settings);
        for (int i = 0; i < steps; ++i) optimiser.step(before + i, gradients, weights);
    }
};

OptimiserSettings plain(Method method) {
    OptimiserSettings settings;
    settings.method = method;
    settings.schedule.rate = 0.1f;
    settings.weight_decay = 0;
    return settings;
}

TEST(Optimiser, MomentumSumsUp) {
    Trial trial;
    trial.run(plain(Method::sgd), 3);
    EXPECT_FLOAT_EQ(trial.weights[0], 2 - 0.1f * (1 + 1.9f + 2.71f));
    EXPECT_FLOAT_EQ(trial.weights[2], 5) << "a statistic is not learned";
}

TEST(Optimiser, NesterovLooksAhead) {
    Trial trial;
    auto settings = plain(Method::sgd);
    settings.nesterov = true;
    trial.run(settings, 2);
    EXPECT_FLOAT_EQ(trial.weights[0], 2 - 0.1f * (1.9f + 2.71f));
}

TEST(Optimiser, AdamStepsAreOfTheRateWhateverTheGradient) {
    Trial trial;
    trial.gradients = {1e-3f, -50, 0, 0, 0, 0};
    trial.run(plain(Method::adamw), 5);
    EXPECT_NEAR(trial.weights[0], 2 - 0.5, 1e-4);
    EXPECT_NEAR(trial.weights[1], 2 + 0.5, 1e-4);
}

TEST(Optimiser, BeginsUponATaughtNetworkAsUponAFreshOne) {
    auto settings = plain(Method::adamw);
    settings.schedule.warm_up = 4;
    settings.schedule.drops = {{500, 0.01f}};
    Trial taught;
    taught.run(settings, 4, 10'000);
    EXPECT_NEAR(taught.weights[0], 2 - 0.01 * (0.25 + 0.5 + 0.75 + 1), 1e-5);
}

TEST(Optimiser, DecayInLossIsTwiceTheWeightInTheGradient) {
    Trial trial;
    auto settings = plain(Method::sgd);
    settings.weight_decay = 0.05f;
    trial.run(settings, 1);
    EXPECT_FLOAT_EQ(trial.weights[0], 2 - 0.1f * (1 + 2 * 0.05f * 2));
    EXPECT_FLOAT_EQ(trial.weights[1], 2 - 0.1f) << "a bias does not decay";
}

TEST(Optimiser, DecoupledDecayStaysOutOfTheMoments) {
    for (const auto method : {Method::sgd, Method::adamw}) {
        Trial trial;
        trial.gradients.assign(6, 0);
        auto settings = plain(method);
        settings.decay = Decay::decoupled;
        settings.weight_decay = 0.5f;
        settings.decay_all = true;
        trial.run(settings, 2);
        EXPECT_FLOAT_EQ(trial.weights[0], 2 * 0.95f * 0.95f);
        EXPECT_FLOAT_EQ(trial.weights[1], 2 * 0.95f * 0.95f);
        EXPECT_FLOAT_EQ(trial.weights[3], 6);
    }
}

TEST(Optimiser, LongGradientsAreCutToTheNorm) {
    Trial trial;
    trial.gradients = {3, 4, 100, 100, 0, 0};
    EXPECT_DOUBLE_EQ(norm_of(trial.gradients, trial.parameters), 5);
    auto settings = plain(Method::sgd);
    settings.most_norm = 1;
    trial.run(settings, 1);
    EXPECT_FLOAT_EQ(trial.weights[0], 2 - 0.1f * 0.6f);
    EXPECT_FLOAT_EQ(trial.weights[1], 2 - 0.1f * 0.8f);
}

TEST(Schedule, DropsWarmUpAndCosine) {
    Schedule zero{0.2f, 0, {{100, 0.02f}, {300, 0.002f}}};
    EXPECT_FLOAT_EQ(zero.at(0, 0), 0.2f);
    EXPECT_FLOAT_EQ(zero.at(99, 99), 0.2f);
    EXPECT_FLOAT_EQ(zero.at(100, 100), 0.02f);
    EXPECT_FLOAT_EQ(zero.at(5000, 5000), 0.002f);
    zero.warm_up = 10;
    EXPECT_FLOAT_EQ(zero.at(0, 0), 0.02f);
    EXPECT_FLOAT_EQ(zero.at(4, 4), 0.1f);
    EXPECT_FLOAT_EQ(zero.at(10, 10), 0.2f);
    EXPECT_FLOAT_EQ(zero.at(300, 4), 0.001f) << "by an optimiser that came late";
    const Schedule cosine{1, 0, {}, 200, 0.1f};
    EXPECT_FLOAT_EQ(cosine.at(0, 0), 1);
    EXPECT_FLOAT_EQ(cosine.at(100, 100), 0.55f);
    EXPECT_FLOAT_EQ(cosine.at(999, 999), 0.1f);
}

}  // namespace
}  // namespace nn::training
