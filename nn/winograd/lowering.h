// From an optimised graph to steps for one board.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "nn/winograd/steps.h"

namespace nn::winograd {

struct Result {
    int buffer = 0, channels = 0;
    bool over_board = false;
};

struct Lowered {
    const Kernels* kernels = nullptr;
    Layout layout;
    std::vector<std::unique_ptr<Step>> steps;
    std::vector<std::size_t> input_sizes;  // numbers of a position
    std::vector<Result> outputs;
};

Lowered lower(const Graph& optimised, std::span<const std::vector<float>> maxima, int board,
              const Kernels& kernels);

}  // namespace nn::winograd
