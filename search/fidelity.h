// How far what a network says in a coarser number format is from what it says in fp32, and how fast
// it says it.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "engine/base/measure.h"
#include "nn/executor.h"
#include "search/evaluator.h"

namespace search {

struct Fidelity {
    double divergence = 0;  // mean of Kullback and Leibler's, of the policy over legal moves
    double value = 0;       // mean |difference| of the chance to win, half of a draw counted
};

// What play may lose by a precision and not notice.
bool tolerable(nn::Precision precision, const Fidelity& fidelity);

// `expected` and `found` answer the same positions.
Fidelity fidelity_of(std::span<const Evaluation> expected, std::span<const Evaluation> found);

// Positions one at a time, as a search asks.
template <engine::Game G>
std::vector<Evaluation> answers_to(Evaluator<G>& evaluator, std::span<const G> positions) {
    std::vector<Evaluation> answers(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const auto moves = positions[i].legal_moves();
        const Query<G> query{&positions[i], &moves, 0, &answers[i]};
        evaluator.evaluate({&query, 1});
    }
    return answers;
}

// The least time of several in which it answers all of them.
template <engine::Game G>
double seconds_for(Evaluator<G>& evaluator, std::span<const G> positions) {
    constexpr int repeats = 3;
    double least = std::numeric_limits<double>::max();
    for (int i = 0; i < repeats; ++i) {
        const double start = engine::processor_seconds();
        answers_to(evaluator, positions);
        least = std::min(least, engine::processor_seconds() - start);
    }
    return least;
}

}  // namespace search
