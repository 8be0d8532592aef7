// One convolution on oneDNN, forward and backward, for one batch size and board. Belongs to the
// thread that makes it: the library wants a primitive run there.
#pragma once

#include <dnnl.hpp>
#include <vector>

#include "nn/graph.h"
#include "nn/onednn/library.h"
#include "nn/training/onednn/blocked.h"

namespace nn::training {

// Where oneDNN computes: the caller's thread.
struct Device {
    dnnl::engine engine = onednn::processor();
    dnnl::stream stream{engine};
};

// Number is float or Bf16: of activations and their gradients. Weights come and go in fp32.
template <class Number>
class Convolution {
   public:
    // `kernel` and `bias` as shapes only.
    Convolution(Device& device, const Node& node, Extent input, int board);

    // Kernel [out, in, k, k], bias [out] or null.
    void load(const float* kernel, const float* bias);
    void forward(Number* x, Number* y);
    // Overwrites the gradient by x.
    void backward_data(Number* y_gradient, Number* x_gradient);
    // Adds to the gradient of the kernel.
    void backward_weights(Number* x, Number* y_gradient);
    // Adds what backward_weights has summed to `kernel` and starts again.
    void collect(float* kernel);

   private:
    void make_forward(bool biased);
    void make_backward();
    dnnl::memory memory_of(const dnnl::memory::desc& description, void* place = nullptr) const;

    Device& device_;
    // Numbers of one output's kernel, and with its inputs filled up to whole blocks.
    std::size_t outputs_ = 0, row_ = 0, filled_row_ = 0;
    dnnl::memory::dims pad_;
    dnnl::memory::desc x_, y_, plain_kernel_, any_kernel_, any_gradient_, bias_;
    dnnl::convolution_forward::primitive_desc hint_;
    dnnl::convolution_forward forward_;
    dnnl::convolution_backward_data backward_data_;
    dnnl::convolution_backward_weights backward_weights_;
    dnnl::reorder to_forward_, to_backward_, to_plain_;
    dnnl::memory plain_, forward_kernel_, backward_kernel_, bias_values_, gradient_;
    std::vector<float> sum_;  // laid out like gradient_
};

}  // namespace nn::training
