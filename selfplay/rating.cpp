#include "selfplay/rating.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace selfplay {

namespace {

constexpr std::array<double, 3> points{0.0, 0.5, 1.0};

using Shares = std::array<double, 3>;  // of losses, draws, wins

struct Observed {
    Shares shares;
    double games;
};

// A result that did not occur may yet occur: it counts as a thousandth of a game.
Observed observe(const Tally& tally) {
    constexpr double least = 1e-3;
    Shares counts{static_cast<double>(tally.losses), static_cast<double>(tally.draws),
                  static_cast<double>(tally.wins)};
    double games = 0;
    for (double& count : counts) games += count = std::max(count, least);
    for (double& count : counts) count /= games;
    return {counts, games};
}

double mean(const Shares& shares) { return 0.5 * shares[1] + shares[2]; }

double variance(const Shares& shares) {
    return 0.25 * shares[1] + shares[2] - mean(shares) * mean(shares);
}

// The shares with mean `target` under which the observed ones are likeliest:
// share / (1 + theta (points - target)), theta such that they have that mean.
Shares likeliest(const Shares& observed, double target) {
    double low = -1 / (1 - target), high = 1 / target;
    const auto tilted = [&](double theta, std::size_t i) {
        return observed[i] / (1 + theta * (points[i] - target));
    };
    for (int step = 0; step < 200; ++step) {
        const double theta = (low + high) / 2;
        double moment = 0;  // falls as theta grows
        for (std::size_t i = 0; i < 3; ++i) moment += tilted(theta, i) * (points[i] - target);
        (moment > 0 ? low : high) = theta;
    }
    const double theta = (low + high) / 2;
    return {tilted(theta, 0), tilted(theta, 1), tilted(theta, 2)};
}

// Log-likelihood of the observed results under `shares`, up to a constant.
double log_likelihood(const Observed& observed, const Shares& shares) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += observed.shares[i] * std::log(shares[i]);
    return observed.games * sum;
}

// The mean furthest from the observed one, towards `end` (0 or 1), that is not refuted.
double furthest_mean(const Observed& observed, double end) {
    constexpr double half_chi_square = 3.841458820694124 / 2;
    const double best = log_likelihood(observed, observed.shares);
    double inside = mean(observed.shares), outside = end;
    for (int step = 0; step < 60; ++step) {
        const double middle = (inside + outside) / 2;
        const auto shares = likeliest(observed.shares, middle);
        const bool refuted = best - log_likelihood(observed, shares) > half_chi_square;
        (refuted ? outside : inside) = middle;
    }
    return inside;
}

}  // namespace

double Tally::score() const { return games() == 0 ? 0.5 : (wins + 0.5 * draws) / games(); }

double elo_of(double share) {
    if (share <= 0) return -std::numeric_limits<double>::infinity();
    if (share >= 1) return std::numeric_limits<double>::infinity();
    return 400 * std::log10(share / (1 - share));
}

double share_of(double elo) { return 1 / (1 + std::pow(10, -elo / 400)); }

Interval score_interval(const Tally& tally) {
    if (tally.games() == 0) return {0, 1};
    const auto observed = observe(tally);
    return {tally.wins + tally.draws == 0 ? 0 : furthest_mean(observed, 0),
            tally.losses + tally.draws == 0 ? 1 : furthest_mean(observed, 1)};
}

double likelihood_of_superiority(const Tally& tally) {
    const int decided = tally.wins + tally.losses;
    if (decided == 0) return 0.5;
    return 0.5 * std::erfc((tally.losses - tally.wins) / std::sqrt(2.0 * decided));
}

double Sprt::lower_bound() const { return std::log(beta / (1 - alpha)); }

double Sprt::upper_bound() const { return std::log((1 - beta) / alpha); }

double Sprt::llr(const Tally& tally) const {
    if (tally.games() == 0) return 0;
    const auto observed = observe(tally);
    if (scale == EloScale::logistic)
        return log_likelihood(observed, likeliest(observed.shares, share_of(elo1))) -
               log_likelihood(observed, likeliest(observed.shares, share_of(elo0)));
    constexpr double elo_per_deviation = 800 / 2.302585092994046;
    const double t0 = elo0 / elo_per_deviation, t1 = elo1 / elo_per_deviation;
    const double t = (mean(observed.shares) - 0.5) / std::sqrt(variance(observed.shares));
    // (Van den Bergh, "Normalized Elo": the ratio of two normal likelihoods with unknown variance.)
    return observed.games / 2 * std::log((1 + (t - t0) * (t - t0)) / (1 + (t - t1) * (t - t1)));
}

Sprt::Verdict Sprt::verdict(const Tally& tally) const {
    const double ratio = llr(tally);
    if (ratio >= upper_bound()) return Verdict::accept_elo1;
    if (ratio <= lower_bound()) return Verdict::accept_elo0;
    return Verdict::undecided;
}

}  // namespace selfplay
