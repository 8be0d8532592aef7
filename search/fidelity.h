// How far what a network says in a coarser number format is from what it says in fp32, and how fast
// it says it.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
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

// Which of these, one at least, answers all of the positions in the least time of several. They
// take turns, and small networks many, since a machine that others use is faster now than then.
template <engine::Game G>
std::size_t fastest_of(std::span<const std::unique_ptr<Evaluator<G>>> evaluators,
                       std::span<const G> positions) {
    constexpr int least_rounds = 3, most_rounds = 100;
    constexpr double least_seconds = 0.2;
    std::vector<double> least(evaluators.size(), std::numeric_limits<double>::max());
    double spent = 0;
    for (int round = 0; round < least_rounds || (round < most_rounds && spent < least_seconds);
         ++round)
        for (std::size_t i = 0; i < evaluators.size(); ++i) {
            const double start = engine::processor_seconds();
            answers_to(*evaluators[i], positions);
            const double seconds = engine::processor_seconds() - start;
            least[i] = std::min(least[i], seconds);
            spent += seconds;
        }
    return static_cast<std::size_t>(std::min_element(least.begin(), least.end()) - least.begin());
}

}  // namespace search
