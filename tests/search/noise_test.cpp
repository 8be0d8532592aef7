#include "search/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "search/temperature.h"

namespace search {
namespace {

TEST(Noise, GumbelsNumbersHaveTheirMeanAndVariance) {
    engine::Random random(1);
    double sum = 0, squares = 0;
    constexpr int count = 20000;
    for (int i = 0; i < count; ++i) {
        const double x = double{gumbel(random)};
        sum += x;
        squares += x * x;
    }
    const double mean = sum / count;
    EXPECT_NEAR(mean, 0.5772, 0.03);
    EXPECT_NEAR(squares / count - mean * mean, 1.6449, 0.1);
}

TEST(Noise, SharesSumToOneAndVaryAsTheyShould) {
    engine::Random random(1);
    for (const float alpha : {0.03f, 0.3f, 3.0f}) {
        constexpr int rounds = 2000;
        constexpr std::size_t count = 20;
        double squares = 0;
        for (int i = 0; i < rounds; ++i) {
            const auto shares = dirichlet(random, count, alpha);
            EXPECT_NEAR(std::accumulate(shares.begin(), shares.end(), 0.0f), 1, 1e-4);
            squares += double{shares[0]} * double{shares[0]};
        }
        const double mean = 1.0 / count, whole = count * double{alpha};
        const double variance = mean * (1 - mean) / (whole + 1);
        EXPECT_NEAR(squares / rounds - mean * mean, variance, 0.2 * variance) << alpha;
    }
}

TEST(Noise, TinyConcentrationsStillMakeShares) {
    engine::Random random(1);
    for (int i = 0; i < 100; ++i) {
        const auto shares = dirichlet(random, 3, 1e-5f);
        EXPECT_NEAR(std::accumulate(shares.begin(), shares.end(), 0.0f), 1, 1e-4);
    }
}

// How often each of three counts is drawn.
std::vector<double> drawn(float temperature) {
    engine::Random random(1);
    const std::uint64_t counts[] = {10, 30, 60};
    std::vector<double> shares(3);
    for (int i = 0; i < 10000; ++i) shares[draw_by_count(counts, temperature, random)] += 1e-4;
    return shares;
}

TEST(Temperature, OneDrawsByTheCounts) {
    const auto shares = drawn(1);
    EXPECT_NEAR(shares[0], 0.1, 0.02);
    EXPECT_NEAR(shares[1], 0.3, 0.02);
}

TEST(Temperature, AHalfDrawsByTheirSquares) {
    const auto shares = drawn(0.5f);
    EXPECT_NEAR(shares[0], 1.0 / 46, 0.01);
    EXPECT_NEAR(shares[1], 9.0 / 46, 0.02);
}

TEST(Temperature, ZeroTakesTheMostVisited) {
    EXPECT_EQ(drawn(0)[2], drawn(1e-20f)[2]);
    EXPECT_NEAR(drawn(0)[2], 1, 1e-9);
    engine::Random random(1);
    const std::uint64_t unvisited[] = {0, 0};
    EXPECT_EQ(draw_by_count(unvisited, 1, random), 0u);
}

}  // namespace
}  // namespace search
