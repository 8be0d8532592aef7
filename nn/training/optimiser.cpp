#include "nn/training/optimiser.h"

#include <cassert>
#include <cmath>

namespace nn::training {

struct Optimiser::Part {
    Slot slot;
    float rate, factor;  // of the gradient, so that its norm is not too large
    float decay;
    std::span<const float> gradients;
    std::span<float> weights;
};

double norm_of(std::span<const float> gradients, const Parameters& parameters) {
    double sum = 0;
    for (const auto& slot : parameters.slots())
        if (slot.role != Role::statistic)
            for (const float x : gradients.subspan(slot.offset, slot.size)) sum += double{x} * x;
    return std::sqrt(sum);
}

Optimiser::Optimiser(const Parameters& parameters, OptimiserSettings settings)
    : parameters_(parameters),
      settings_(std::move(settings)),
      state_(settings_.method == Method::adamw ? 2 : 1, std::vector<float>(parameters.size())) {}

void Optimiser::step(std::int64_t steps, std::span<const float> gradients,
                     std::span<float> weights) {
    assert(gradients.size() == parameters_.size() && weights.size() == parameters_.size());
    float factor = 1;
    if (settings_.most_norm > 0) {
        const double norm = norm_of(gradients, parameters_);
        if (norm > settings_.most_norm) factor = static_cast<float>(settings_.most_norm / norm);
    }
    for (const auto& slot : parameters_.slots()) {
        if (slot.role == Role::statistic) continue;
        const bool decays = slot.role == Role::matrix || settings_.decay_all;
        const Part part{slot,      settings_.schedule.at(steps, updates_),
                        factor,    decays ? settings_.weight_decay : 0,
                        gradients, weights};
        if (settings_.method == Method::sgd)
            descend(part);
        else
            adapt(part);
    }
    ++updates_;
}

// v = momentum v + g; w -= rate v, or with Nesterov's look ahead rate (g + momentum v).
void Optimiser::descend(const Part& part) {
    const bool in_loss = settings_.decay == Decay::in_loss;
    const float in_gradient = in_loss ? 2 * part.decay : 0;
    const float kept = in_loss ? 1 : 1 - part.rate * part.decay;
    for (std::size_t i = part.slot.offset; i < part.slot.offset + part.slot.size; ++i) {
        auto& weight = part.weights[i];
        auto& velocity = state_[0][i];
        const float gradient = part.factor * part.gradients[i] + in_gradient * weight;
        velocity = settings_.momentum * velocity + gradient;
        const float move = settings_.nesterov ? gradient + settings_.momentum * velocity : velocity;
        weight = kept * weight - part.rate * move;
    }
}

// m and v are running means of g and g²; w -= rate m / (sqrt(v) + epsilon), both unbiased.
void Optimiser::adapt(const Part& part) {
    const bool in_loss = settings_.decay == Decay::in_loss;
    const float in_gradient = in_loss ? 2 * part.decay : 0;
    const float kept = in_loss ? 1 : 1 - part.rate * part.decay;
    const float b1 = settings_.first_moment, b2 = settings_.second_moment;
    const auto count = static_cast<double>(updates_ + 1);
    const auto unbias1 = static_cast<float>(1 / (1 - std::pow(double{b1}, count)));
    const auto unbias2 = static_cast<float>(1 / (1 - std::pow(double{b2}, count)));
    for (std::size_t i = part.slot.offset; i < part.slot.offset + part.slot.size; ++i) {
        auto& weight = part.weights[i];
        const float gradient = part.factor * part.gradients[i] + in_gradient * weight;
        state_[0][i] = b1 * state_[0][i] + (1 - b1) * gradient;
        state_[1][i] = b2 * state_[1][i] + (1 - b2) * gradient * gradient;
        const float deviation = std::sqrt(state_[1][i] * unbias2) + settings_.epsilon;
        weight = kept * weight - part.rate * state_[0][i] * unbias1 / deviation;
    }
}

}  // namespace nn::training
