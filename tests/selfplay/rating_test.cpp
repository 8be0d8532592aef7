#include "selfplay/rating.h"

#include <gtest/gtest.h>

#include <cmath>

namespace selfplay {
namespace {

TEST(Rating, EloAndShareAreInverse) {
    EXPECT_NEAR(elo_of(0.75), 190.848, 1e-3);
    EXPECT_NEAR(elo_of(0.5), 0, 1e-12);
    for (const double elo : {-400.0, -3.5, 0.0, 120.0})
        EXPECT_NEAR(elo_of(share_of(elo)), elo, 1e-9);
    EXPECT_TRUE(std::isinf(elo_of(1)));
    EXPECT_LT(elo_of(0), 0);
}

TEST(Rating, IntervalOfManyGamesIsTheNormalOne) {
    // Score 0.55, variance of a result 0.55 - 0.3025 - 0.4 / 4 = 0.1475 with 400 draws in 1000.
    const auto interval = score_interval({350, 400, 250});
    const double deviation = std::sqrt(0.1475 / 1000);
    EXPECT_NEAR(interval.low, 0.55 - 1.96 * deviation, 5e-4);
    EXPECT_NEAR(interval.high, 0.55 + 1.96 * deviation, 5e-4);
}

TEST(Rating, IntervalOfAClosedResultIsOneSided) {
    // All of n games won: refuted are the scores s with s^n < exp(-3.84 / 2).
    const auto won = score_interval({10, 0, 0});
    EXPECT_NEAR(won.low, std::exp(-1.9207 / 10), 2e-3);
    EXPECT_EQ(won.high, 1);
    const auto lost = score_interval({0, 0, 10});
    EXPECT_EQ(lost.low, 0);
    EXPECT_NEAR(lost.high, 1 - won.low, 1e-9);
    const auto drawn = score_interval({0, 10, 0});
    EXPECT_LT(drawn.low, 0.5);
    EXPECT_GT(drawn.low, 0.35);
    EXPECT_NEAR(drawn.low + drawn.high, 1, 1e-9);
}

TEST(Rating, NoGamesSayNothing) {
    EXPECT_EQ(Tally{}.score(), 0.5);
    EXPECT_EQ(score_interval({}).low, 0);
    EXPECT_EQ(score_interval({}).high, 1);
    EXPECT_EQ(likelihood_of_superiority({0, 5, 0}), 0.5);
    EXPECT_EQ((Sprt{0, 5, 0.05, 0.05}.llr({})), 0);
}

TEST(Rating, LikelihoodOfSuperiority) {
    // Phi((60 - 40) / sqrt(100)) = Phi(2).
    EXPECT_NEAR(likelihood_of_superiority({60, 17, 40}), 0.97725, 1e-5);
    EXPECT_NEAR(likelihood_of_superiority({40, 17, 60}), 1 - 0.97725, 1e-5);
}

TEST(Sprt, BoundsAreWalds) {
    const Sprt sprt{0, 5, 0.05, 0.05};
    EXPECT_NEAR(sprt.upper_bound(), std::log(19), 1e-12);
    EXPECT_NEAR(sprt.lower_bound(), -std::log(19), 1e-12);
    const Sprt uneven{0, 5, 0.01, 0.10};
    EXPECT_NEAR(uneven.upper_bound(), std::log(90), 1e-12);
    EXPECT_NEAR(uneven.lower_bound(), std::log(0.10 / 0.99), 1e-12);
}

// The quadratic approximation of the generalised ratio, good when all differences are small:
// (s1 - s0) (2 s - s0 - s1) n / (2 variance).
double approximate_llr(const Tally& tally, double elo0, double elo1) {
    const double n = tally.games(), s = tally.score();
    const double variance = (tally.wins + 0.25 * tally.draws) / n - s * s;
    const double s0 = share_of(elo0), s1 = share_of(elo1);
    return (s1 - s0) * (2 * s - s0 - s1) * n / (2 * variance);
}

TEST(Sprt, RatioAgreesWithItsApproximation) {
    for (const Tally& tally : {Tally{2100, 5900, 2000}, Tally{510, 0, 490}, Tally{300, 380, 320}})
        EXPECT_NEAR((Sprt{0, 5, 0.05, 0.05}.llr(tally)), approximate_llr(tally, 0, 5), 0.02);
}

TEST(Sprt, NormalisedEloIsLogisticWithoutDrawsNearZero) {
    // Without draws a result deviates by 0.5, so 1 normalised Elo is 1 / 347.4 of that: s = t / 2.
    const Tally tally{520, 0, 480};
    const Sprt normalised{0, 10, 0.05, 0.05, EloScale::normalised};
    const double as_logistic = elo_of(0.5 + 0.5 * 10 / 347.4356);
    EXPECT_NEAR(normalised.llr(tally), (Sprt{0, as_logistic, 0.05, 0.05}.llr(tally)), 0.02);
}

TEST(Sprt, DecidesBothWays) {
    const Sprt sprt{0, 50, 0.05, 0.05};
    EXPECT_EQ(sprt.verdict({5, 0, 5}), Sprt::Verdict::undecided);
    EXPECT_EQ(sprt.verdict({300, 0, 200}), Sprt::Verdict::accept_elo1);
    EXPECT_EQ(sprt.verdict({200, 0, 300}), Sprt::Verdict::accept_elo0);
    // Nothing but wins is evidence too.
    EXPECT_EQ(sprt.verdict({60, 0, 0}), Sprt::Verdict::accept_elo1);
}

}  // namespace
}  // namespace selfplay
