#include "search/fidelity.h"

#include <cassert>

namespace search {

namespace {

constexpr Fidelity bound_of(nn::Precision precision) {
    switch (precision) {
        case nn::Precision::bf16:
            return {0.001, 0.003};
        case nn::Precision::int16:
            return {0.002, 0.004};
        case nn::Precision::int8:
            return {0.01, 0.02};
        case nn::Precision::fp32:
            break;
    }
    return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
}

double divergence(std::span<const float> expected, std::span<const float> found) {
    constexpr double least = 1e-30;
    assert(expected.size() == found.size());
    double sum = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const double p = double{expected[i]};
        if (p > 0) sum += p * std::log(p / std::max(double{found[i]}, least));
    }
    return sum;
}

double winrate(const Evaluation& answer) { return double{answer.win} + 0.5 * double{answer.draw}; }

}  // namespace

bool tolerable(nn::Precision precision, const Fidelity& fidelity) {
    const auto bound = bound_of(precision);
    return fidelity.divergence < bound.divergence && fidelity.value < bound.value;
}

Fidelity fidelity_of(std::span<const Evaluation> expected, std::span<const Evaluation> found) {
    assert(expected.size() == found.size());
    Fidelity mean;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        mean.divergence += divergence(expected[i].priors, found[i].priors);
        mean.value += std::abs(winrate(expected[i]) - winrate(found[i]));
    }
    const auto count = static_cast<double>(std::max<std::size_t>(expected.size(), 1));
    return {mean.divergence / count, mean.value / count};
}

}  // namespace search
