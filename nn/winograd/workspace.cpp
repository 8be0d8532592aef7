#include "nn/winograd/workspace.h"

namespace nn::winograd {

namespace {

template <class Number>
std::vector<Buffer<Number>> buffers_of(const std::vector<std::size_t>& sizes, int positions) {
    std::vector<Buffer<Number>> buffers;
    buffers.reserve(sizes.size());
    for (const auto size : sizes) buffers.emplace_back(size * static_cast<std::size_t>(positions));
    return buffers;
}

}  // namespace

Workspace::Workspace(const Kernels& set, const Layout& plan)
    : kernels(set),
      layout(plan),
      floats(buffers_of<float>(plan.floats, plan.positions)),
      vectors(buffers_of<float>(plan.vectors, plan.positions)),
      words(buffers_of<std::int16_t>(plan.words, plan.positions)),
      transformed(plan.transformed),
      products(plan.products),
      biases(plan.channels * static_cast<std::size_t>(plan.positions)),
      scales(plan.channels * static_cast<std::size_t>(plan.positions)),
      borders(plan.channels * 81),
      pooled(2 * plan.channels),
      entries(plan.entries),
      starts(static_cast<std::size_t>(plan.points()) + 1),
      counts(static_cast<std::size_t>(plan.points()) + 1),
      bits(plan.entries / 64 + plan.entries / static_cast<std::size_t>(plan.points()) + 1) {}

}  // namespace nn::winograd
