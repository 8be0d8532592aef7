#include "selfplay/training/elo.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace selfplay::training {

namespace {

const double scale = std::log(10.0) / 400;

// Slope and curvature of the logarithm of the posterior, by Elo of all players but the first.
struct Slopes {
    Eigen::VectorXd first;
    Eigen::MatrixXd second;

    void add(std::size_t player, double slope) {
        if (player > 0) first(static_cast<long>(player) - 1) += slope;
    }
    void bend(std::size_t a, std::size_t b, double curvature) {
        if (a > 0 && b > 0) second(static_cast<long>(a) - 1, static_cast<long>(b) - 1) += curvature;
    }
};

Slopes slopes_at(const Eigen::VectorXd& elo, std::span<const Belief> beliefs,
                 std::span<const Pairing> pairings) {
    const auto free = static_cast<long>(beliefs.size()) - 1;
    Slopes slopes{Eigen::VectorXd::Zero(free), Eigen::MatrixXd::Zero(free, free)};
    for (std::size_t i = 1; i < beliefs.size(); ++i) {
        const double weight = 1 / (beliefs[i].deviation * beliefs[i].deviation);
        slopes.add(i, (beliefs[i].elo - elo(static_cast<long>(i))) * weight);
        slopes.bend(i, i, weight);
    }
    for (const auto& [a, b, tally] : pairings) {
        const double expected = share_of(elo(static_cast<long>(a)) - elo(static_cast<long>(b)));
        const double games = tally.games();
        const double excess = scale * games * (tally.score() - expected);
        const double curvature = scale * scale * games * expected * (1 - expected);
        if (games == 0) continue;
        slopes.add(a, excess);
        slopes.add(b, -excess);
        slopes.bend(a, a, curvature);
        slopes.bend(b, b, curvature);
        slopes.bend(a, b, -curvature);
        slopes.bend(b, a, -curvature);
    }
    return slopes;
}

}  // namespace

// Newton's method; the posterior is concave.
std::vector<Strength> strengths(std::span<const Belief> beliefs,
                                std::span<const Pairing> pairings) {
    const auto count = static_cast<long>(beliefs.size());
    std::vector<Strength> result(beliefs.size());
    if (count == 0) return result;
    Eigen::VectorXd elo(count);
    for (long i = 0; i < count; ++i) elo(i) = beliefs[static_cast<std::size_t>(i)].elo;
    constexpr int rounds = 50;
    constexpr double longest = 200;  // a step, so that far starts do not overshoot
    for (int round = 0; round < rounds && count > 1; ++round) {
        const auto slopes = slopes_at(elo, beliefs, pairings);
        const Eigen::VectorXd step = slopes.second.ldlt().solve(slopes.first);
        elo.tail(count - 1) += step.cwiseMin(longest).cwiseMax(-longest);
        if (step.cwiseAbs().maxCoeff() < 0.01) break;
    }
    const auto slopes = slopes_at(elo, beliefs, pairings);
    const Eigen::MatrixXd covariance = slopes.second.inverse();
    for (long i = 0; i < count; ++i)
        result[static_cast<std::size_t>(i)] = {
            elo(i), i == 0 ? 0 : std::sqrt(std::max(covariance(i - 1, i - 1), 0.0))};
    return result;
}

}  // namespace selfplay::training
