// What differentiates a graph. A trainer belongs to the thread that made it, computes there, starts
// none, and serves any batch and board that the graph serves; it makes what a new size needs when
// it first meets one. Weights and gradients are rows as nn/training/parameters.h lays them out;
// batch and outputs are as for nn/executor.h. Made by make_trainer.
#pragma once

#include <memory>
#include <span>

#include "nn/executor.h"

namespace nn::training {

// Where a batch norm takes mean and variance from.
enum class Statistics : std::uint8_t { of_batch, running };

class Trainer {
   public:
    virtual ~Trainer() = default;

    // The weights of all that follows. `row` is copied.
    virtual void load(std::span<const float> row) = 0;

    // Fills the outputs, and keeps what backward needs. Fails with engine::Error when the graph
    // does not serve this board.
    virtual void forward(const Batch& batch, Statistics statistics = Statistics::of_batch) = 0;

    // After a forward with the batch's statistics, once: from the loss's gradients by each output
    // (laid out as the output; an empty one is all zeros) to those by all weights, which are summed
    // until collected.
    virtual void backward(std::span<const std::span<const float>> output_gradients) = 0;

    // Adds the sums to `row` and starts again from zero. In the places of a batch norm's mean and
    // variance stand sums over samples: of the mean and of the mean square of the batch they were
    // in.
    virtual void collect(std::span<float> row) = 0;
};

// The reference, by Eigen, in fp32. `graph` must be valid.
std::unique_ptr<Trainer> make_reference_trainer(const Graph& graph);

// The fastest there is here for this precision (fp32 or bf16, which keeps weights and their
// gradients in fp32).
std::unique_ptr<Trainer> make_trainer(const Graph& graph, Precision precision);

// fp32 or bf16: in which this processor multiplies and adds faster, measured once (0.1 s). Some
// have instructions for bf16 that are slower than those for fp32.
Precision faster_precision();

}  // namespace nn::training
