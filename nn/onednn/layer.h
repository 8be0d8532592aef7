// One convolution or dense layer of the library, its weights, bias, residual and activation fused,
// for one batch size. Made and run by the same thread.
#pragma once

#include <dnnl.hpp>
#include <string>
#include <vector>

#include "nn/onednn/packed.h"

namespace nn::onednn {

struct LayerCall {
    std::size_t node = 0;  // its key among packed weights
    const Node* layer = nullptr;
    int positions = 0, board = 0;
    const void* in = nullptr;
    Format in_format = Format::f32;
    const std::vector<float>* in_steps = nullptr;  // of u8 and s8
    void* out = nullptr;
    Format out_format = Format::f32;
    const std::vector<float>* out_inverse_steps = nullptr;  // of u8 and s8
    bool sum = false;                                       // adds to what `out` holds
};

class Layer {
   public:
    Layer(const LayerCall& call, PackedWeights& packed);
    void run(const dnnl::stream& stream) const;
    // What the library chose, for tests: a slow fallback is a defect.
    const std::string& implementation() const { return implementation_; }

   private:
    template <class PrimitiveDescriptor>
    void adopt(const PrimitiveDescriptor& descriptor, const LayerCall& call, const Weights& weights,
               PackedWeights& packed, const dnnl::memory::dims& dims);

    dnnl::primitive primitive_;
    std::vector<dnnl::memory> memories_;
    std::vector<dnnl_exec_arg_t> arguments_;
    std::vector<float> bias_;
    std::string implementation_;
};

// Activations that the library fuses; others are a step of their own.
bool fuses(Activation activation);

}  // namespace nn::onednn
