// From gradients to new weights: SGD with momentum, and AdamW (Loshchilov & Hutter 2019). Its state
// is a few rows laid out like the weights, which a checkpoint keeps.
#pragma once

#include <span>
#include <vector>

#include "nn/training/parameters.h"
#include "nn/training/schedule.h"

namespace nn::training {

enum class Method : std::uint8_t { sgd, adamw };

// How weights are drawn to zero: by c‖w‖² in the loss (AlphaGo Zero), or by a factor of
// 1 - rate · c a step, beside the gradient.
enum class Decay : std::uint8_t { in_loss, decoupled };

struct OptimiserSettings {
    Method method = Method::sgd;
    Schedule schedule = {};
    float momentum = 0.9f;  // SGD
    bool nesterov = false;
    float first_moment = 0.9f, second_moment = 0.999f, epsilon = 1e-8f;  // AdamW
    Decay decay = Decay::in_loss;
    float weight_decay = 1e-4f;  // c
    bool decay_all = false;      // biases and batch norms too
    float most_norm = 0;         // of the gradient of all weights, else it is scaled; 0: any
};

// The Euclidean norm over all weights that learn.
double norm_of(std::span<const float> gradients, const Parameters& parameters);

class Optimiser {
   public:
    Optimiser(const Parameters& parameters, OptimiserSettings settings);

    // The step after `steps` of the network's, which its schedule goes by. Statistics of batch
    // norms stay as they are.
    void step(std::int64_t steps, std::span<const float> gradients, std::span<float> weights);

    // Momentum; of AdamW both moments.
    const std::vector<std::vector<float>>& state() const { return state_; }
    // The steps that the state is of: fewer than the network's where that was taught before.
    std::int64_t updates() const { return updates_; }
    void restore(std::vector<std::vector<float>> state, std::int64_t updates) {
        state_ = std::move(state);
        updates_ = updates;
    }
    const OptimiserSettings& settings() const { return settings_; }

   private:
    struct Part;  // one slot's share of a step
    void descend(const Part& part);
    void adapt(const Part& part);

    const Parameters& parameters_;
    OptimiserSettings settings_;
    std::vector<std::vector<float>> state_;
    std::int64_t updates_ = 0;
};

}  // namespace nn::training
