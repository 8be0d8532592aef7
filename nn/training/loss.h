// What a network's answers cost, and the gradient of the cost by them. A term ties an output of the
// graph to a kind of loss; a sample may lack the target of a term (weight 0), and its weight may be
// negative (REINFORCE). Every loss is the mean over the numbers of one answer.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "nn/graph.h"

namespace nn::training {

enum class Loss : std::uint8_t {
    policy,        // softmax cross-entropy of logits with the moves listed
    distribution,  // softmax cross-entropy of logits with a probability for each (win, draw, loss)
    square,        // (answer - target)², of a value in [-1, 1]
    ownership,     // cross-entropy of (1 + answer) / 2 with (1 + target) / 2 (Wu 2019)
    score,         // Huber's, quadratic up to 12 points (Wu 2019)
    moves_left,    // Huber's of plies / 20, quadratic up to half (as lc0)
};

struct Term {
    std::string output;
    Loss loss = Loss::policy;
    float weight = 1;  // in the sum that is minimised
};

// A term for each output of the graph whose name says what it is.
std::vector<Term> usual_terms(const Graph& graph);

// The targets of one term for a batch.
struct Target {
    // One row a sample, as wide as the output; for a policy the probabilities of `moves`.
    std::span<const float> numbers;
    // Of a policy: sample i has moves[starts[i]] up to moves[starts[i + 1]].
    std::span<const int> starts, moves;
    // Of a policy: the moves listed are the legal ones, and the softmax is over them alone.
    bool legal_only = true;
    // A weight a sample; all 1 when empty.
    std::span<const float> weights;
};

// Sums over samples; what is not asked for by the kind of loss stays 0.
struct Cost {
    double weight = 0;  // of samples, without signs
    double loss = 0;
    double hits = 0;          // policy, distribution: the likeliest is the target's likeliest
    double square_error = 0;  // square, distribution: of the expected value (win less loss)

    Cost& operator+=(const Cost& other);
    // Means over the samples that had the target.
    double mean_loss() const { return mean(loss); }
    double accuracy() const { return mean(hits); }
    double mean_square_error() const { return mean(square_error); }

   private:
    double mean(double sum) const { return weight > 0 ? sum / weight : 0; }
};

// Which samples of a batch, and what their losses count in the gradient.
struct Share {
    int samples = 1, first = 0;
    float factor = 1;
};

// Those samples of `target` against the rows of `answers`. Writes into `gradients` (laid out like
// answers) that of `factor` times the sum of the weighted losses.
Cost measure(Loss loss, std::span<const float> answers, const Target& target, Share share,
             std::span<float> gradients);

}  // namespace nn::training
