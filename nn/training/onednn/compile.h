// From a graph to the steps of the oneDNN trainer, for one batch size and board.
#pragma once

#include <memory>
#include <vector>

#include "nn/training/onednn/steps.h"

namespace nn::training {

// The steps of the tape's graph in order; reserves what they need on both sides. Every output has
// its plain value.
template <class Number>
std::vector<std::unique_ptr<Step>> compile_steps(Blocked<Number>& blocked);

}  // namespace nn::training
