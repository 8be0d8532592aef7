// Batch norm (Ioffe & Szegedy 2015) over samples and points: with xhat = (x - mean) / deviation,
// y = scale xhat + shift. While learning, mean and variance are the batch's own.
#include <cassert>
#include <cmath>

#include "nn/training/operations.h"

namespace nn::training {

namespace {

constexpr int scale = 2, shift = 3;  // places among the weights; mean and variance come before

struct Moments {
    double mean = 0, variance = 0;
};

Moments moments_of(Tape& tape, int x, int channel) {
    Moments moments;
    const double count = double{1} * tape.size * tape.points(x);
    tape.for_samples([&](int i) {
        moments.mean += tape.sample(x, i).row(channel).cast<double>().sum() / count;
    });
    tape.for_samples([&](int i) {
        const auto row = tape.sample(x, i).row(channel).cast<double>().array();
        moments.variance += (row - moments.mean).square().sum() / count;
    });
    return moments;
}

// The running statistics are updated by whoever owns them, from these sums.
void report(Tape& tape, int n, int channel, const Moments& moments) {
    const auto [mean, variance] = moments;
    tape.weight_gradient(n, 0)(channel, 0) += static_cast<float>(tape.size * mean);
    tape.weight_gradient(n, 1)(channel, 0) +=
        static_cast<float>(tape.size * (variance + mean * mean));
}

// Keeps mean and 1 / deviation per channel.
void forward(Tape& tape, int n) {
    const int x = tape.input(n, 0), channels = tape.channels(n);
    auto& kept = tape.kept[at(n)];
    kept.resize(2 * at(channels));
    for (int c = 0; c < channels; ++c) {
        Moments moments{tape.weight(n, 0)(c, 0), tape.weight(n, 1)(c, 0)};
        if (tape.learning) report(tape, n, c, moments = moments_of(tape, x, c));
        const double inverse = 1 / std::sqrt(moments.variance + double{tape.node(n).epsilon});
        kept[2 * at(c)] = static_cast<float>(moments.mean);
        kept[2 * at(c) + 1] = static_cast<float>(inverse);
        const float factor = tape.weight(n, scale)(c, 0) * kept[2 * at(c) + 1];
        tape.for_samples([&](int i) {
            tape.sample(n, i).row(c) =
                (tape.sample(x, i).row(c).array() - kept[2 * at(c)]) * factor +
                tape.weight(n, shift)(c, 0);
        });
    }
}

// dx = scale / deviation (dy - mean(dy) - xhat mean(dy xhat)).
void backward(Tape& tape, int n) {
    assert(tape.learning);
    const int x = tape.input(n, 0);
    const float count = static_cast<float>(tape.size) * static_cast<float>(tape.points(n));
    for (int c = 0; c < tape.channels(n); ++c) {
        const float mean = tape.kept[at(n)][2 * at(c)], inverse = tape.kept[at(n)][2 * at(c) + 1];
        const auto normal = [&](int i) {
            return (tape.sample(x, i).row(c).array() - mean) * inverse;
        };
        const auto gradient = [&](int i) { return tape.sample_gradient(n, i).row(c).array(); };
        double sum = 0, product = 0;
        tape.for_samples([&](int i) {
            sum += gradient(i).sum();
            product += (gradient(i) * normal(i)).sum();
        });
        tape.weight_gradient(n, scale)(c, 0) += static_cast<float>(product);
        tape.weight_gradient(n, shift)(c, 0) += static_cast<float>(sum);
        if (!tape.wants_gradient(x)) continue;
        const float mean_gradient = static_cast<float>(sum) / count;
        const float mean_product = static_cast<float>(product) / count;
        tape.for_samples([&](int i) {
            tape.sample_gradient(x, i).row(c).array() +=
                tape.weight(n, scale)(c, 0) * inverse *
                (gradient(i) - mean_gradient - normal(i) * mean_product);
        });
    }
}

}  // namespace

Rule batch_norm_rule() { return {forward, backward}; }

}  // namespace nn::training
