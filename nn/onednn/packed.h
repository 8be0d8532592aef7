// Weights in the order and number format that a layer of the library asked for, made once and
// shared by executors on several threads.
#pragma once

#include <dnnl.hpp>
#include <map>
#include <mutex>
#include <vector>

#include "nn/onednn/kernels.h"

namespace nn::onednn {

// A layer's weights before the library orders them: quantised for u8 and s8 input.
struct Weights {
    std::vector<float> values;       // as [out, in, …]
    std::vector<signed char> whole;  // in their place when quantised
    std::vector<float> bias;
    std::vector<float> scales;  // per output, of the whole numbers' sum; empty: none
};

// `steps`: what a step of each input channel is worth; empty when the input is not quantised.
Weights prepare(const Node& layer, const std::vector<float>& steps);

class PackedWeights {
   public:
    // The weights of `node`, as `wanted`; `weights` is what prepare yields. Any thread.
    dnnl::memory weights(std::size_t node, const Weights& weights, const dnnl::memory::dims& dims,
                         const dnnl::memory::desc& wanted);
    // For kernels().small: blocks of small_block outputs.
    const float* small(std::size_t node, const Tensor& weights);

   private:
    std::mutex mutex_;
    std::map<std::size_t, std::vector<dnnl::memory>> packed_;
    std::map<std::size_t, std::vector<float>> small_;
};

}  // namespace nn::onednn
