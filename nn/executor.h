// What runs a graph. An executor belongs to one thread at a time, computes on the caller's thread,
// starts none, and allocates nothing once it has seen a batch size and board. Executors on several
// threads may share one graph.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "nn/graph.h"

namespace nn {

// Inputs and outputs in the order of Graph::input_nodes and Graph::outputs; each holds `size`
// positions one after another, a position channel after channel, a channel row after row. An empty
// output span is left out.
struct Batch {
    int size = 0;
    int board = 0;  // side
    std::span<const std::span<const float>> inputs;
    std::span<const std::span<float>> outputs;
};

class Executor {
   public:
    virtual ~Executor() = default;
    // Fails with engine::Error when the network does not serve this board.
    virtual void run(const Batch& batch) = 0;
};

// From the most exact to the least; int16 is as exact as bf16 and the fastest.
enum class Precision : std::uint8_t { fp32, bf16, int8, int16 };

std::string_view name_of(Precision precision);
std::optional<Precision> precision_from(std::string_view name);

}  // namespace nn
