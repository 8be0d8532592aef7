// The trainer on oneDNN: convolutions by the library, what surrounds them on blocked values, the
// rest by the reference's rules. See nn/training/trainer.h for what it promises.
#pragma once

#include <memory>

#include "nn/training/trainer.h"

namespace nn::training {

// In fp32 where the processor does not multiply bf16.
std::unique_ptr<Trainer> make_onednn_trainer(const Graph& graph, Precision precision);

}  // namespace nn::training
