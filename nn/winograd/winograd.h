// The fast path: networks of 3x3 convolutions in int16 by Winograd's minimal filtering, everything
// around them fused, first convolutions by their nonzero inputs alone. Kernels for AVX-512 with
// VNNI and for AVX2, chosen by what the processor has. See nn/executor.h for what executors
// promise.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "nn/program.h"
#include "nn/winograd/kernels.h"

namespace nn::winograd {

// Whether this processor has the instructions.
bool available();

// Whether every operation of a graph, as optimise() leaves it, can be run here on this board.
bool serves(const Graph& optimised, int board);

struct Lowered;

// Packed weights, shared by the executors made of them. `maxima`: per node of `optimised` and
// channel, the largest magnitude that calibration saw; values well beyond are clipped. Needs
// available() and serves().
class Program : public nn::Program {
   public:
    Program(const Graph& optimised, std::span<const std::vector<float>> maxima, int board,
            const Kernels* kernels = best_kernels());
    std::unique_ptr<Executor> make_executor() const override;

   private:
    std::shared_ptr<const Lowered> lowered_;
};

}  // namespace nn::winograd
