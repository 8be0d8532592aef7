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
    dnnl::memory rows_x = {}, rows_y = {};  // scratch for Rows, as large as was needed so far
};

// Whether convolutions of this number are computed over rows of channels (NHWC), to which blocks
// are brought and from which they are taken again: AMX is had in oneDNN for nothing else, and even
// so is several times faster than vdpbf16ps on the processors that have both.
template <class Number>
bool by_rows();

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
    // What the library reads or writes for the blocks at `place`; `store` puts what it wrote there.
    struct Side {
        dnnl::memory::desc blocks, computed;  // the same unless by rows
        dnnl::memory Device::*scratch = nullptr;
        dnnl::reorder to_rows = {}, to_blocks = {};
    };
    Side side(const dnnl::memory::dims& dims, dnnl::memory Device::*scratch);
    dnnl::memory rows_of(const Side& side) const;
    dnnl::memory fetch(const Side& side, Number* place) const;
    dnnl::memory room(const Side& side, Number* place) const;
    void store(const Side& side, dnnl::memory computed, Number* place) const;

    Device& device_;
    // Numbers of one output's kernel, and with its inputs filled up to whole blocks.
    std::size_t outputs_ = 0, row_ = 0, filled_row_ = 0;
    dnnl::memory::dims pad_;
    Side x_, y_;
    dnnl::memory::desc plain_kernel_, any_kernel_, any_gradient_, bias_;
    dnnl::convolution_forward::primitive_desc hint_;
    dnnl::convolution_forward forward_;
    dnnl::convolution_backward_data backward_data_;
    dnnl::convolution_backward_weights backward_weights_;
    dnnl::reorder to_forward_, to_backward_, to_plain_;
    dnnl::memory plain_, forward_kernel_, backward_kernel_, bias_values_, gradient_;
    std::vector<float> sum_;  // laid out like gradient_
};

}  // namespace nn::training
