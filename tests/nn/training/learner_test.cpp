// What other trainers lack: one batch is learned by heart by every kind of network, values have the
// right sign, equal seeds give equal weights, a run goes on as if it had never stopped.
#include "nn/training/learner.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "nn/eigen/executor.h"
#include "nn/load.h"
#include "nn/passes.h"
#include "nn/training/norms.h"
#include "problem.h"

namespace nn::training {
namespace {

LearnerSettings quick(float rate = 0.005f) {
    LearnerSettings settings;
    settings.optimiser.method = Method::adamw;
    settings.optimiser.schedule.rate = rate;
    settings.optimiser.decay = Decay::decoupled;
    settings.optimiser.weight_decay = 0;
    return settings;
}

// The mean loss of every term after `steps` of one batch.
Report learned_by_heart(const Graph& graph, LearnerSettings settings, int steps, int board) {
    const Problem problem(graph, board, 16);
    Learner learner(graph, std::move(settings));
    Report report;
    for (int i = 0; i < steps; ++i) report = learner.step(problem.samples);
    EXPECT_EQ(report.fault, "");
    return report;
}

void expect_learned_by_heart(const Graph& graph, int board = 5) {
    const auto report = learned_by_heart(graph, quick(), 250, board);
    const auto terms = usual_terms(graph);
    for (std::size_t t = 0; t < terms.size(); ++t)
        EXPECT_LT(report.costs[t].mean_loss(), 0.05) << terms[t].output;
}

TEST(Learner, EveryKindOfTowerLearnsABatchByHeart) {
    for (const auto attention :
         {Attention::none, Attention::squeeze_excitation, Attention::global_pooling})
        for (const bool any_board : {false, true}) {
            auto about = small_tower();
            about.attention = attention;
            about.globals = 4;
            about.wdl = about.ownership = about.moves_left = any_board;
            if (any_board) {
                about.facts.board = 0;
                about.policy = PolicyHead::points;
                about.flat_value = false;
            }
            expect_learned_by_heart(built(about));
        }
}

TEST(Learner, PlanesOfMovesAreLearnedByHeart) {
    auto about = small_tower();
    about.policy = PolicyHead::planes;
    about.move_planes = 7;
    expect_learned_by_heart(built(about));
}

TEST(Learner, AlphaGosNetworksLearnABatchByHeart) {
    engine::Random random(4);
    Facts facts;
    facts.board = 5;
    facts.channels = 8;
    for (const auto& graph :
         {build_alphago_policy(facts, 6, random), build_alphago_value(facts, 7, random),
          build_alphago_value(facts, 7, random, 8)}) {
        const auto report = learned_by_heart(graph, quick(0.003f), 200, 5);
        EXPECT_LT(report.costs[0].mean_loss(), 0.05) << graph.outputs[0].name;
    }
}

// Norms measured on a batch compute, by that batch's statistics and by their own, what the network
// computed without them.
TEST(Norms, FittedToABatchTheyChangeNothing) {
    engine::Random random(6);
    const auto plain = build_alphago_policy(naive::facts_of(5, 4, 8), 6, random);
    const Problem problem(plain, 5, 16);
    const auto settings = quick(0.001f);
    const auto before = Learner(plain, settings).evaluate(problem.samples);
    const auto fitted = fit_norms(unfold_batch_norms(plain), problem.samples, settings);
    const auto& first = fitted.nodes[2];
    ASSERT_EQ(first.operation, Operation::batch_norm);
    EXPECT_NE(first.weights[0].values[0], 0);
    Learner learner(fitted, settings);
    EXPECT_NEAR(learner.evaluate(problem.samples).loss, before.loss, 0.01);
    EXPECT_NEAR(learner.step(problem.samples).loss, before.loss, 0.01);
}

TEST(Learner, PlainLayersLearnAToyProblemInStatedTime) {
    engine::Random random(5);
    const auto graph = build_mlp({}, {2, 16, 1}, random);
    auto settings = quick(0.02f);
    settings.terms = {{"output", Loss::square, 1}};
    Learner learner(graph, settings);
    const std::vector<float> inputs = {0, 0, 0, 1, 1, 0, 1, 1}, exclusive_or = {-1, 1, 1, -1};
    const Samples samples{4, 9, {inputs}, {{exclusive_or, {}, {}, true, {}}}};
    Report report;
    for (int i = 0; i < 200; ++i) report = learner.step(samples);
    EXPECT_LT(report.costs[0].mean_loss(), 0.01);
}

// The mover wins where the first plane is full, loses where the second is: what is played with says
// so with the right sign.
TEST(Learner, ValuesHaveTheRightSign) {
    for (const bool wdl : {false, true}) {
        auto about = small_tower();
        about.wdl = wdl;
        const auto graph = built(about);
        Problem problem(graph, 5, 16);
        auto& planes = problem.inputs[0];
        auto& target = problem.targets[1];
        for (std::size_t i = 0; i < 16; ++i) {
            const bool wins = i % 2 == 0;
            std::fill_n(planes.begin() + static_cast<long>(i * 100), 25, wins ? 1.0f : 0.0f);
            std::fill_n(planes.begin() + static_cast<long>(i * 100 + 25), 25, wins ? 0.0f : 1.0f);
            if (wdl)
                for (std::size_t k = 0; k < 3; ++k)
                    target[3 * i + k] = k == (wins ? 0u : 2u) ? 1.0f : 0.0f;
            else
                target[i] = wins ? 1.0f : -1.0f;
        }
        auto settings = quick();
        settings.average = 0.9f;
        settings.norm_average = 0.9f;
        Learner learner(graph, settings);
        for (int i = 0; i < 100; ++i) learner.step(problem.samples);
        std::vector<float> policy(16 * 26), value(16 * (wdl ? 3 : 1));
        const std::vector<std::span<float>> outputs = {policy, value};
        eigen::Program(learner.averaged())
            .make_executor()
            ->run({16, 5, problem.samples.inputs, outputs});
        for (std::size_t i = 0; i < 16; ++i) {
            const float expected = wdl ? value[3 * i] - value[3 * i + 2] : value[i];
            EXPECT_GT(i % 2 == 0 ? expected : -expected, 0.5f) << i;
        }
    }
}

TEST(Learner, EqualRunsGiveEqualWeightsForAnyNumberOfThreads) {
    const auto graph = built(small_tower());
    const Problem problem(graph, 5, 13);
    for (const int threads : {1, 3}) {
        auto settings = quick();
        settings.threads = threads;
        settings.micro_batch = 4;
        Learner one(graph, settings), other(graph, settings);
        for (int i = 0; i < 5; ++i) {
            one.step(problem.samples);
            other.step(problem.samples);
        }
        EXPECT_EQ(one.newest(), other.newest());
    }
}

TEST(Learner, ThreadsShareABatchAndSumItsGradients) {
    auto about = small_tower();
    const auto graph = built(about);
    const Problem problem(graph, 5, 12);
    LearnerSettings settings;
    settings.micro_batch = 3;
    Learner alone(graph, settings);
    settings.threads = 4;
    Learner crew(graph, settings);
    const auto one = alone.step(problem.samples), other = crew.step(problem.samples);
    EXPECT_NEAR(one.loss, other.loss, 1e-5);
    EXPECT_NEAR(one.gradient_norm, other.gradient_norm, 1e-4 * one.gradient_norm);
    const Parameters parameters(graph);
    const auto a = parameters.read(alone.newest()), b = parameters.read(crew.newest());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-5);
}

class LearnerFiles : public testing::Test {
   protected:
    void SetUp() override { std::filesystem::create_directories(folder_); }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    std::filesystem::path folder_ = std::filesystem::temp_directory_path() /
                                    testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(LearnerFiles, ARunGoesOnAsIfItHadNeverStopped) {
    auto graph = built(small_tower());
    graph.facts.steps = 1000;  // of another run
    const Problem problem(graph, 5, 8);
    for (const auto method : {Method::sgd, Method::adamw}) {
        auto settings = quick();
        settings.optimiser.method = method;
        settings.optimiser.schedule.warm_up = 10;
        settings.average = 0.9f;
        Learner whole(graph, settings);
        for (int i = 0; i < 3; ++i) whole.step(problem.samples);
        whole.save(folder_ / "checkpoint");
        Learner resumed(built(small_tower(), 77), settings);
        resumed.restore(folder_ / "checkpoint");
        EXPECT_EQ(resumed.steps(), 1003);
        for (int i = 0; i < 3; ++i) {
            whole.step(problem.samples);
            resumed.step(problem.samples);
        }
        EXPECT_EQ(whole.newest().nodes, resumed.newest().nodes);
        EXPECT_EQ(whole.averaged().nodes, resumed.averaged().nodes);
    }
}

TEST_F(LearnerFiles, ACheckpointIsANetworkToo) {
    const auto graph = built(small_tower());
    Learner learner(graph, quick());
    learner.step(Problem(graph, 5, 8).samples);
    learner.save(folder_ / "checkpoint");
    EXPECT_EQ(load(folder_ / "checkpoint"), learner.newest());
}

TEST_F(LearnerFiles, RefusesWhatIsNoCheckpointOfIts) {
    const auto graph = built(small_tower());
    const auto path = folder_ / "checkpoint";
    Learner learner(graph, quick());
    const auto before = learner.newest();
    save(graph, path);
    EXPECT_THROW(learner.restore(path), engine::Error) << "a bare network";
    auto settings = quick();
    settings.optimiser.method = Method::sgd;
    Learner(graph, settings).save(path);
    EXPECT_THROW(learner.restore(path), engine::Error) << "another optimiser";
    auto about = small_tower();
    about.facts.channels = 8;
    Learner(built(about), quick()).save(path);
    EXPECT_THROW(learner.restore(path), engine::Error) << "another network";
    learner.save(path);
    auto bytes = engine::read_file(path);
    bytes[bytes.size() - 100] ^= 1;
    engine::write_file(path, bytes);
    EXPECT_THROW(learner.restore(path), engine::Error) << "a flipped bit";
    EXPECT_EQ(learner.newest(), before);
}

TEST(Learner, NoNumbersAreReportedAndNotLearned) {
    const auto graph = built(small_tower());
    Problem problem(graph, 5, 8);
    Learner learner(graph, quick());
    learner.step(problem.samples);
    const auto before = learner.newest();
    problem.targets[1][3] = std::nanf("");
    const auto report = learner.step(problem.samples);
    EXPECT_EQ(report.fault, "the loss of \"value\" is nan");
    EXPECT_EQ(learner.newest(), before);
    problem.targets[1][3] = 1;
    EXPECT_EQ(learner.step(problem.samples).fault, "");
}

TEST(Learner, AbsentTargetsCostNothing) {
    const auto graph = built(small_tower());
    Problem problem(graph, 5, 8);
    const std::vector<float> absent(8, 0.0f);
    Learner learner(graph, quick());
    const auto both = learner.evaluate(problem.samples);
    problem.samples.targets[1].weights = absent;
    const auto report = learner.evaluate(problem.samples);
    EXPECT_EQ(report.costs[1].weight, 0);
    EXPECT_NEAR(report.loss, both.costs[0].mean_loss(), 1e-6);
    EXPECT_NEAR(both.loss, both.costs[0].mean_loss() + both.costs[1].mean_loss(), 1e-6);
}

TEST(Learner, AverageFollowsSlowly) {
    const auto graph = built(small_tower());
    const Problem problem(graph, 5, 8);
    auto settings = quick();
    settings.average = 0.75f;
    Learner learner(graph, settings);
    learner.step(problem.samples);
    const Parameters parameters(graph);
    const auto start = parameters.read(graph), newest = parameters.read(learner.newest()),
               average = parameters.read(learner.averaged());
    for (std::size_t i = 0; i < start.size(); ++i)
        EXPECT_NEAR(average[i], 0.75f * start[i] + 0.25f * newest[i], 1e-6);
}

TEST(Learner, RefusesSettingsThatCannotBe) {
    const auto graph = built(small_tower());
    auto settings = quick();
    settings.threads = 0;
    EXPECT_THROW(Learner(graph, settings), engine::Error);
    settings = quick();
    settings.average = 1;
    EXPECT_THROW(Learner(graph, settings), engine::Error);
    settings = quick();
    settings.terms = {{"no such output", Loss::square, 1}};
    EXPECT_THROW(Learner(graph, settings), engine::Error);
}

}  // namespace
}  // namespace nn::training
