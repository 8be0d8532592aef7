// Every loss: its gradient by finite differences, its value where it is known.
#include "nn/training/loss.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../naive.h"

namespace nn::training {
namespace {

using Row = std::vector<float>;

struct Problem {
    Loss loss;
    Row answers;
    Target target;
    int samples;

    double value(const Row& at) const {
        Row gradients(at.size());
        return measure(loss, at, target, {samples, 0, 1}, gradients).loss;
    }
    void expect_true_gradient(double tolerance = 2e-3) const {
        Row gradients(answers.size());
        measure(loss, answers, target, {samples, 0, 1}, gradients);
        for (std::size_t i = 0; i < answers.size(); ++i) {
            Row high = answers, low = answers;
            high[i] += 0.01f;
            low[i] -= 0.01f;
            const double step = double{high[i]} - double{low[i]};
            EXPECT_NEAR(gradients[i], (value(high) - value(low)) / step, tolerance) << i;
        }
    }
};

const Row logits = {1, -1, 0.5f, 2, 0, 0.25f, -0.5f, 1.5f};

TEST(Losses, PolicyOverLegalMoves) {
    const Row probabilities = {0.25f, 0.75f, 0, 1};
    const std::vector<int> starts = {0, 3, 4}, moves = {0, 2, 3, 1};
    const Problem problem{Loss::policy, logits, {probabilities, starts, moves, true, {}}, 2};
    problem.expect_true_gradient();
    const double sum = std::exp(1) + std::exp(0.5) + std::exp(2);
    EXPECT_NEAR(problem.value(logits), 0.25 * (std::log(sum) - 1) + 0.75 * (std::log(sum) - 0.5),
                1e-5);
    Row gradients(8, 9.0f);
    const auto cost = measure(problem.loss, logits, problem.target, {2, 0, 1}, gradients);
    EXPECT_EQ(gradients[1], 0) << "an illegal move";
    EXPECT_EQ(cost.hits, 1) << "the second sample's only move; the first prefers move 3";
    EXPECT_EQ(cost.accuracy(), 0.5);
}

TEST(Losses, PolicyOverAllMoves) {
    const Row probabilities = {0.5f, 0.5f, 1};
    const std::vector<int> starts = {0, 2, 3}, moves = {3, 0, 3};
    const Problem problem{Loss::policy, logits, {probabilities, starts, moves, false, {}}, 2};
    problem.expect_true_gradient();
}

TEST(Losses, Distribution) {
    const Row target = {0.2f, 0.3f, 0.5f, 1, 0, 0};
    const Row answers = {0.5f, -1, 1, 2, 0, -1};
    const Problem problem{Loss::distribution, answers, {target, {}, {}, true, {}}, 2};
    problem.expect_true_gradient();
    Row gradients(6);
    const auto cost = measure(problem.loss, answers, problem.target, {2, 0, 1}, gradients);
    EXPECT_EQ(cost.accuracy(), 1);
    const double odds = (std::exp(2) - std::exp(-1)) / (std::exp(2) + 1 + std::exp(-1));
    const double first =
        (std::exp(0.5) - std::exp(1)) / (std::exp(0.5) + std::exp(-1) + std::exp(1));
    EXPECT_NEAR(cost.square_error, std::pow(odds - 1, 2) + std::pow(first + 0.3, 2), 1e-5);
}

TEST(Losses, SquareOwnershipScoreMovesLeft) {
    const Row answers = {0.5f, -0.25f, 0.75f, 0};
    const Row target = {1, -1, -0.5f, 0.1f};
    for (const auto loss : {Loss::square, Loss::ownership})
        Problem{loss, answers, {target, {}, {}, true, {}}, 2}.expect_true_gradient();
    const Row points = {3, -30, 40, 7.5f}, scores = {5, 3, 12, -2};
    for (const auto loss : {Loss::score, Loss::moves_left})
        Problem{loss, points, {scores, {}, {}, true, {}}, 4}.expect_true_gradient(5e-3);
    const Row far = {20}, near = {5};
    const Problem score{Loss::score, far, {near, {}, {}, true, {}}, 1};
    EXPECT_DOUBLE_EQ(score.value(far), 12 * (15 - 6));
}

TEST(Losses, SaturatedOwnershipStaysANumber) {
    const Row answers = {1, -1}, target = {-1, 1};
    Row gradients(2);
    const auto cost =
        measure(Loss::ownership, answers, {target, {}, {}, true, {}}, {1, 0, 1}, gradients);
    EXPECT_TRUE(std::isfinite(cost.loss));
    for (const float x : gradients) EXPECT_TRUE(std::isfinite(x));
    EXPECT_GT(gradients[0], 0);
}

TEST(Losses, WeightsLeaveOutScaleAndTurn) {
    const Row answers = {0.5f, 0.5f, 0.5f}, target = {1, 1, 1}, weights = {0, 2, -1};
    Row gradients(3);
    const auto cost =
        measure(Loss::square, answers, {target, {}, {}, true, weights}, {3, 0, 0.1f}, gradients);
    EXPECT_EQ(gradients[0], 0);
    EXPECT_FLOAT_EQ(gradients[1], -0.2f);
    EXPECT_FLOAT_EQ(gradients[2], 0.1f);
    EXPECT_FLOAT_EQ(static_cast<float>(cost.weight), 3);
    EXPECT_FLOAT_EQ(static_cast<float>(cost.mean_square_error()), 0.25f);
}

TEST(Losses, LaterSamplesOfABatch) {
    const Row answers = {0.5f}, target = {9, 9, 1};
    Row gradients(1);
    const auto cost =
        measure(Loss::square, answers, {target, {}, {}, true, {}}, {1, 2, 1}, gradients);
    EXPECT_FLOAT_EQ(static_cast<float>(cost.loss), 0.25f);
}

}  // namespace
}  // namespace nn::training
