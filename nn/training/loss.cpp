#include "nn/training/loss.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "nn/index.h"

namespace nn::training {

namespace {

using Numbers = std::span<const float>;

// One sample's cost; `gradient` gets that of the loss alone.
struct Sample {
    Numbers answer, target;
    std::span<const int> moves;
    bool legal_only;
    std::span<float> gradient;
};

std::size_t peak_of(Numbers numbers) {
    return static_cast<std::size_t>(std::max_element(numbers.begin(), numbers.end()) -
                                    numbers.begin());
}

// Turns logits into probabilities and yields the logarithm of their sum.
double softmax(std::span<float> logits) {
    const float most = *std::max_element(logits.begin(), logits.end());
    double sum = 0;
    for (auto& x : logits) sum += x = std::exp(x - most);
    for (auto& x : logits) x = static_cast<float>(x / sum);
    return most + std::log(sum);
}

// -Σ t log softmax(z); by z: (Σ t) softmax(z) - t.
double cross_entropy(Numbers logits, Numbers target, std::span<float> gradient) {
    std::copy(logits.begin(), logits.end(), gradient.begin());
    const double log_sum = softmax(gradient);
    const float total = std::accumulate(target.begin(), target.end(), 0.0f);
    double loss = 0;
    for (std::size_t i = 0; i < target.size(); ++i) {
        loss += target[i] * (log_sum - logits[i]);
        gradient[i] = gradient[i] * total - target[i];
    }
    return loss;
}

Cost distribution(const Sample& sample) {
    Cost cost;
    cost.loss = cross_entropy(sample.answer, sample.target, sample.gradient);
    cost.hits = peak_of(sample.answer) == peak_of(sample.target) ? 1 : 0;
    if (sample.answer.size() != 3) return cost;
    std::vector<float> odds(sample.answer.begin(), sample.answer.end());
    softmax(odds);
    const double error = odds[0] - odds[2] - (sample.target[0] - sample.target[2]);
    cost.square_error = error * error;
    return cost;
}

// The softmax over the listed moves alone, or over all with zeros where none is listed.
Cost policy(const Sample& sample) {
    std::fill(sample.gradient.begin(), sample.gradient.end(), 0.0f);
    const auto count = sample.legal_only ? sample.moves.size() : sample.answer.size();
    std::vector<float> logits(count), target(count), gradient(count);
    if (sample.legal_only) {
        for (std::size_t i = 0; i < count; ++i) logits[i] = sample.answer[at(sample.moves[i])];
        std::copy(sample.target.begin(), sample.target.end(), target.begin());
    } else {
        std::copy(sample.answer.begin(), sample.answer.end(), logits.begin());
        for (std::size_t i = 0; i < sample.moves.size(); ++i)
            target[at(sample.moves[i])] = sample.target[i];
    }
    Cost cost;
    if (count == 0) return cost;
    cost.loss = cross_entropy(logits, target, gradient);
    cost.hits = peak_of(logits) == peak_of(target) ? 1 : 0;
    for (std::size_t i = 0; i < count; ++i)
        sample.gradient[sample.legal_only ? at(sample.moves[i]) : i] = gradient[i];
    return cost;
}

Cost square(const Sample& sample) {
    const auto count = static_cast<float>(sample.answer.size());
    Cost cost;
    for (std::size_t i = 0; i < sample.answer.size(); ++i) {
        const float error = sample.answer[i] - sample.target[i];
        cost.loss += double{error} * error / count;
        sample.gradient[i] = 2 * error / count;
    }
    cost.square_error = cost.loss;
    return cost;
}

// -t log p - (1 - t) log(1 - p) with p = (1 + answer) / 2; p stays clear of 0 and 1.
Cost ownership(const Sample& sample) {
    constexpr float margin = 1e-5f;
    const auto count = static_cast<float>(sample.answer.size());
    Cost cost;
    for (std::size_t i = 0; i < sample.answer.size(); ++i) {
        const float p = std::clamp((1 + sample.answer[i]) / 2, margin, 1 - margin);
        const float t = (1 + sample.target[i]) / 2;
        cost.loss -= (t * std::log(p) + (1 - t) * std::log(1 - p)) / count;
        sample.gradient[i] = (p - t) / (p * (1 - p)) / 2 / count;
    }
    return cost;
}

// Huber 1964 with u = (answer - target) / unit: u² / 2 up to `bend`, straight from there.
Cost huber(const Sample& sample, float unit, float bend) {
    const auto count = static_cast<float>(sample.answer.size());
    Cost cost;
    for (std::size_t i = 0; i < sample.answer.size(); ++i) {
        const float u = (sample.answer[i] - sample.target[i]) / unit;
        const float size = std::abs(u);
        cost.loss += (size <= bend ? u * u / 2 : bend * (size - bend / 2)) / count;
        sample.gradient[i] = std::clamp(u, -bend, bend) / unit / count;
    }
    return cost;
}

Cost cost_of(Loss loss, const Sample& sample) {
    switch (loss) {
        case Loss::policy:
            return policy(sample);
        case Loss::distribution:
            return distribution(sample);
        case Loss::square:
            return square(sample);
        case Loss::ownership:
            return ownership(sample);
        case Loss::score:
            return huber(sample, 1, 12);
        case Loss::moves_left:
            return huber(sample, 20, 0.5f);
    }
    return {};
}

Sample sample_of(Loss loss, const Target& target, int index, Numbers answer,
                 std::span<float> gradient) {
    Sample sample{answer, {}, {}, target.legal_only, gradient};
    if (loss != Loss::policy) {
        sample.target = target.numbers.subspan(at(index) * answer.size(), answer.size());
        return sample;
    }
    const auto start = at(target.starts[at(index)]), end = at(target.starts[at(index) + 1]);
    sample.target = target.numbers.subspan(start, end - start);
    sample.moves = target.moves.subspan(start, end - start);
    return sample;
}

void weigh(Cost& cost, double factor) {
    cost.weight = std::abs(factor);
    cost.loss *= factor;
    cost.hits *= std::abs(factor);
    cost.square_error *= std::abs(factor);
}

}  // namespace

Cost& Cost::operator+=(const Cost& other) {
    weight += other.weight;
    loss += other.loss;
    hits += other.hits;
    square_error += other.square_error;
    return *this;
}

std::vector<Term> usual_terms(const Graph& graph) {
    const Term known[] = {
        {"policy", Loss::policy, 1},     {"wdl", Loss::distribution, 1},
        {"value", Loss::square, 1},      {"ownership", Loss::ownership, 0.15f},
        {"score", Loss::score, 0.0015f}, {"moves_left", Loss::moves_left, 0.1f},
    };
    std::vector<Term> terms;
    for (const auto& term : known)
        if (graph.output(term.output)) terms.push_back(term);
    return terms;
}

Cost measure(Loss loss, std::span<const float> answers, const Target& target, Share share,
             std::span<float> gradients) {
    assert(share.samples > 0 && gradients.size() == answers.size());
    const auto width = answers.size() / at(share.samples);
    Cost sum;
    for (int i = 0; i < share.samples; ++i) {
        const auto sample =
            sample_of(loss, target, share.first + i, answers.subspan(at(i) * width, width),
                      gradients.subspan(at(i) * width, width));
        const float weight = target.weights.empty() ? 1 : target.weights[at(share.first + i)];
        auto cost = weight == 0 ? Cost{} : cost_of(loss, sample);
        weigh(cost, weight);
        sum += cost;
        for (auto& x : sample.gradient) x = weight == 0 ? 0 : x * weight * share.factor;
    }
    return sum;
}

}  // namespace nn::training
