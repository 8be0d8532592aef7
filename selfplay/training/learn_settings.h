// How a network learns: optimiser, batches, averages. A value; it may change when a run is resumed,
// the optimiser aside.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "engine/base/option.h"
#include "nn/training/learner.h"

namespace selfplay::training {

inline constexpr std::array<std::string_view, 2> method_names = {"sgd", "adamw"};
// What the convolutions compute in; fastest is fp32 or bf16, as the processor has it.
enum class Numbers : std::uint8_t { fp32, bf16, fastest };
inline constexpr std::array<std::string_view, 3> number_names = {"fp32", "bf16", "auto"};

struct LearnSettings {
    int batch = 256, micro_batch = 64;
    nn::training::Method optimiser = nn::training::Method::sgd;
    float rate = 0.02f;
    int warm_up = 100;
    int first_drop = 0, second_drop = 0, third_drop = 0;
    float drop_factor = 0.1f;
    float momentum = 0.9f;
    float weight_decay = 1e-4f;
    float most_norm = 0;
    float average = 0.99f;
    float ownership_weight = 0.15f, score_weight = 0.0015f, value_weight = 1;
    Numbers numbers = Numbers::fastest;

    static constexpr auto options() {
        using engine::Choice;
        using engine::Option;
        using P = LearnSettings;
        return std::tuple{
            Option<P, int>{"learn-batch", &P::batch, 2, 65536, "samples a step"},
            Option<P, int>{"micro-batch", &P::micro_batch, 2, 4096,
                           "of them a thread takes so many at once"},
            Choice<P, nn::training::Method>{"optimiser", &P::optimiser, method_names,
                                            "of the weights"},
            Option<P, float>{"rate", &P::rate, 1e-7f, 10, "learning rate"},
            Option<P, int>{"warm-up", &P::warm_up, 0, 1'000'000, "steps in which it rises"},
            Option<P, int>{"first-drop", &P::first_drop, 0, 100'000'000,
                           "step at which the rate falls; 0: never"},
            Option<P, int>{"second-drop", &P::second_drop, 0, 100'000'000, "likewise again"},
            Option<P, int>{"third-drop", &P::third_drop, 0, 100'000'000, "likewise again"},
            Option<P, float>{"drop-factor", &P::drop_factor, 1e-3f, 1, "by which it falls"},
            Option<P, float>{"momentum", &P::momentum, 0, 0.9999f, "of sgd"},
            Option<P, float>{"weight-decay", &P::weight_decay, 0, 1, "c of c * |w|^2 in the loss"},
            Option<P, float>{"most-norm", &P::most_norm, 0, 1e6f,
                             "of the gradient, else it is scaled; 0: any"},
            Option<P, float>{"average", &P::average, 0, 0.99999f,
                             "of the weights that play, what a step keeps; 0: the newest play"},
            Option<P, float>{"value-weight", &P::value_weight, 0, 100, "in the loss"},
            Option<P, float>{"ownership-weight", &P::ownership_weight, 0, 100, "in the loss"},
            Option<P, float>{"score-weight", &P::score_weight, 0, 100, "in the loss"},
            Choice<P, Numbers>{"learn-precision", &P::numbers, number_names,
                               "of the convolutions while learning; auto: the faster"},
        };
    }
};

// Fails with engine::Error on drops that are out of order.
nn::training::LearnerSettings learner_settings(const LearnSettings& settings,
                                               const nn::Graph& graph, int threads);

}  // namespace selfplay::training
