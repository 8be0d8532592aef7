// What the results of a match say about the strength of its two sides: Elo difference with its
// interval, likelihood of superiority, and the sequential probability ratio test. Everything is
// seen from the first engine's side. Pure functions.
#pragma once

#include <optional>
#include <string_view>

namespace selfplay {

struct Tally {
    int wins = 0, draws = 0, losses = 0;

    int games() const { return wins + draws + losses; }
    // Share of the points, 0..1; one half when nothing has been played.
    double score() const;
    bool operator==(const Tally&) const = default;
};

// The logistic Elo difference that a score of `share` (0..1) stands for; infinite at 0 and 1.
double elo_of(double share);
double share_of(double elo);

struct Interval {
    double low = 0, high = 0;
};

// 95 % interval of the score (0..1): the scores that the results do not refute by the likelihood
// ratio (Owen's empirical likelihood over win, draw and loss, chi square 3.84). Stays proper when
// every game was won.
Interval score_interval(const Tally& tally);

// Probability (0..1) that the first engine is the stronger, draws set aside (normal
// approximation); one half without decided games.
double likelihood_of_superiority(const Tally& tally);

// Elo as the logistic scale, or normalised by the standard deviation of a game's result, which
// makes one game's worth of evidence the same whatever the share of draws.
enum class EloScale { logistic, normalised };

struct Sprt {
    double elo0 = 0, elo1 = 5, alpha = 0.05, beta = 0.05;
    EloScale scale = EloScale::logistic;

    // Wald's bounds on the log-likelihood ratio.
    double lower_bound() const;
    double upper_bound() const;
    // Generalised log-likelihood ratio of elo1 against elo0 (Van den Bergh): for both the likeliest
    // win, draw and loss shares with that mean, in closed form for the normalised scale.
    double llr(const Tally& tally) const;

    enum class Verdict { undecided, accept_elo0, accept_elo1 };
    Verdict verdict(const Tally& tally) const;
};

}  // namespace selfplay
