// The fastest trainer here (on oneDNN, in fp32 and where the processor has it bf16) against the
// reference, on the same graphs.
#include <gtest/gtest.h>

#include <map>

#include "case.h"
#include "nn/builders.h"
#include "nn/peak.h"
#include "problem.h"

namespace nn::training {
namespace {

double length(std::span<const float> row) {
    double sum = 0;
    for (const float x : row) sum += double{x} * x;
    return std::sqrt(sum);
}

// |a - b| / |b|, or by `least` where b is smaller.
double distance(std::span<const float> a, std::span<const float> b, double least = 1e-3) {
    Row difference(a.begin(), a.end());
    for (std::size_t i = 0; i < a.size(); ++i) difference[i] -= b[i];
    return length(difference) / std::max(length(b), least);
}

void expect_reference(const Graph& graph, int board, int size, Precision precision,
                      double tolerance) {
    GradientCase test(graph, board, size);
    const auto reference = make_reference_trainer(graph);
    const auto expected = test.gradients_by(*reference);
    const auto outputs = test.outputs;
    const auto trainer = make_trainer(graph, precision);
    const auto found = test.gradients_by(*trainer);
    for (std::size_t o = 0; o < outputs.size(); ++o)
        EXPECT_LT(distance(test.outputs[o], outputs[o]), tolerance) << graph.outputs[o].name;
    EXPECT_LT(distance(found, expected), tolerance);
    // A weight of few numbers, or with a gradient that is next to nothing, is less exact.
    const Parameters parameters(graph);
    for (const auto& slot : parameters.slots()) {
        const auto part = [&](const Row& row) {
            return std::span(row).subspan(slot.offset, slot.size);
        };
        EXPECT_LT(distance(part(found), part(expected), 0.01 * length(expected)), 4 * tolerance)
            << graph.nodes[at(slot.node)].name << " weight " << slot.weight << " board " << board;
    }
}

Graph tower(Attention attention, bool any_board, int channels) {
    auto about = small_tower();
    about.facts.channels = channels;
    about.facts.board = any_board ? 0 : 9;
    about.policy_size = 82;
    about.attention = attention;
    about.globals = 3;
    about.wdl = about.ownership = about.score = about.moves_left = true;
    if (any_board) {
        about.policy = PolicyHead::points;
        about.flat_value = false;
    }
    return built(about);
}

TEST(FastTrainer, EveryOperation) {
    for (const auto& [board, size] : {std::pair{3, 1}, {5, 4}, {9, 3}}) {
        engine::Random random(2);
        expect_reference(naive::every_operation(random, board, 20), board, size, Precision::fp32,
                         1e-3);
    }
}

TEST(FastTrainer, EveryTower) {
    for (const auto attention :
         {Attention::none, Attention::squeeze_excitation, Attention::global_pooling})
        for (const bool any_board : {false, true})
            expect_reference(tower(attention, any_board, 24), 9, 5, Precision::fp32, 1e-3);
}

TEST(FastTrainer, Bf16IsNear) {
    for (const int channels : {16, 32, 48, 64})
        for (const int size : {7, 8})
            expect_reference(tower(Attention::none, false, channels), 9, size, Precision::bf16,
                             0.15);
}

TEST(FastTrainer, OneTrainerServesBoardsAndBatchesInAnyOrder) {
    const auto graph = tower(Attention::global_pooling, true, 16);
    const auto trainer = make_trainer(graph, Precision::fp32);
    const auto reference = make_reference_trainer(graph);
    for (const auto& [board, size] : {std::pair{9, 3}, {5, 2}, {9, 3}, {13, 1}}) {
        GradientCase test(graph, board, size);
        const auto expected = test.gradients_by(*reference), found = test.gradients_by(*trainer);
        EXPECT_LT(distance(found, expected), 1e-3) << board;
        test.run(*reference, Statistics::running);
        const auto outputs = test.outputs;
        test.run(*trainer, Statistics::running);
        for (std::size_t o = 0; o < outputs.size(); ++o)
            EXPECT_LT(distance(test.outputs[o], outputs[o]), 1e-3) << board;
    }
}

TEST(FastTrainer, GradientsOfSeveralBatchesAreSummed) {
    const auto graph = tower(Attention::none, false, 16);
    GradientCase test(graph, 9, 4);
    const auto trainer = make_trainer(graph, Precision::fp32);
    const auto once = test.gradients_by(*trainer);
    Row twice(once.size());
    for (int i = 0; i < 2; ++i) {
        test.run(*trainer, Statistics::of_batch);
        trainer->backward(
            std::vector<std::span<const float>>(test.factors.begin(), test.factors.end()));
    }
    trainer->collect(twice);
    for (auto& x : twice) x /= 2;
    EXPECT_LT(distance(twice, once), 1e-6);
}

TEST(FastTrainer, TheFasterPrecisionIsNeverTheOneFarBehind) {
    const auto faster = faster_precision();
    EXPECT_EQ(faster_precision(), faster);
    std::map<Precision, double> peaks;
    for (int turn = 0; turn < 10; ++turn)
        for (const auto precision : {Precision::bf16, Precision::fp32})
            peaks[precision] = std::max(peaks[precision], peak_rate(precision, 0.01));
    const auto other = faster == Precision::fp32 ? Precision::bf16 : Precision::fp32;
    EXPECT_LT(peaks[other], 1.5 * peaks[faster]);
}

TEST(FastTrainer, LearnsABatchByHeartInBothPrecisions) {
    const auto graph = tower(Attention::none, false, 16);
    const Problem problem(graph, 9, 16);
    for (const auto precision : {Precision::fp32, Precision::bf16}) {
        LearnerSettings settings;
        settings.optimiser.method = Method::adamw;
        settings.optimiser.schedule.rate = 0.005f;
        settings.precision = precision;
        settings.threads = 2;
        Learner learner(graph, settings);
        Report report;
        for (int i = 0; i < 100; ++i) report = learner.step(problem.samples);
        EXPECT_LT(report.costs[0].mean_loss(), 0.05);
        EXPECT_LT(report.costs[1].mean_loss(), 0.05);
    }
}

}  // namespace
}  // namespace nn::training
