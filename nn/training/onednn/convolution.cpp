#include "nn/training/onednn/convolution.h"

#include <algorithm>
#include <type_traits>

namespace nn::training {

namespace {

using dnnl::memory;
using Tag = memory::format_tag;
using Type = memory::data_type;

constexpr auto direct = dnnl::algorithm::convolution_direct;
const memory::dims& strides() {
    static const memory::dims one = {1, 1};
    return one;
}

template <class Number>
constexpr Type type_of() {
    return std::is_same_v<Number, float> ? Type::f32 : Type::bf16;
}

}  // namespace

template <class Number>
bool by_rows() {
    return std::is_same_v<Number, Bf16> && onednn::has_tiles();
}

template <class Number>
Convolution<Number>::Convolution(Device& device, const Node& node, Extent input, int board)
    : device_(device) {
    const auto& shape = node.weights[0].shape;
    // Whole blocks of inputs: for fewer than 16 channels the library has but a slow loop.
    const int inputs = input.blocks() * lanes;
    const memory::dims kernel = {shape[0], inputs, shape[2], shape[3]};
    const auto type = type_of<Number>();
    pad_ = {shape[2] / 2, shape[2] / 2};
    x_ = side({input.samples, inputs, board, board}, &Device::rows_x);
    y_ = side({input.samples, shape[0], board, board}, &Device::rows_y);
    plain_kernel_ = {kernel, Type::f32, Tag::oihw};
    any_kernel_ = {kernel, type, Tag::any};
    any_gradient_ = {kernel, Type::f32, Tag::any};
    bias_ = {{shape[0]}, Type::f32, Tag::x};
    plain_ = memory_of(plain_kernel_);
    outputs_ = static_cast<std::size_t>(shape[0]);
    row_ = node.weights[0].values.size() / outputs_;
    filled_row_ = plain_kernel_.get_size() / sizeof(float) / outputs_;
    make_forward(node.weights.size() > 1);
    make_backward();
    // Made once: making one costs more than running it on a small network.
    to_forward_ = dnnl::reorder(plain_, forward_kernel_);
    to_backward_ = dnnl::reorder(plain_, backward_kernel_);
    to_plain_ = dnnl::reorder(gradient_, plain_);
}

template <class Number>
void Convolution<Number>::make_forward(bool biased) {
    using Forward = dnnl::convolution_forward;
    constexpr auto kind = dnnl::prop_kind::forward_training;
    const auto description = biased ? Forward::desc(kind, direct, x_.computed, any_kernel_, bias_,
                                                    y_.computed, strides(), pad_, pad_)
                                    : Forward::desc(kind, direct, x_.computed, any_kernel_,
                                                    y_.computed, strides(), pad_, pad_);
    hint_ = {description, device_.engine};
    forward_ = Forward(hint_);
    forward_kernel_ = memory_of(hint_.weights_desc());
    if (biased) bias_values_ = memory_of(bias_);
}

template <class Number>
void Convolution<Number>::make_backward() {
    using Data = dnnl::convolution_backward_data;
    using Weights = dnnl::convolution_backward_weights;
    const Data::primitive_desc data(
        {direct, x_.computed, any_kernel_, y_.computed, strides(), pad_, pad_}, device_.engine,
        hint_);
    backward_data_ = Data(data);
    backward_kernel_ = memory_of(data.weights_desc());
    const Weights::primitive_desc weights(
        {direct, x_.computed, any_gradient_, y_.computed, strides(), pad_, pad_}, device_.engine,
        hint_);
    backward_weights_ = Weights(weights);
    gradient_ = memory_of(weights.diff_weights_desc());
    sum_.assign(weights.diff_weights_desc().get_size() / sizeof(float), 0.0f);
}

template <class Number>
memory Convolution<Number>::memory_of(const memory::desc& description, void* place) const {
    return place ? memory(description, device_.engine, place) : memory(description, device_.engine);
}

template <class Number>
auto Convolution<Number>::side(const memory::dims& dims, memory Device::*scratch) -> Side {
    const memory::desc blocks(dims, type_of<Number>(), Tag::nChw16c);
    if (!by_rows<Number>()) return {blocks, blocks};
    Side side{blocks, {dims, type_of<Number>(), Tag::nhwc}, scratch};
    auto& rows = device_.*scratch;
    if (!rows || rows.get_desc().get_size() < side.computed.get_size())
        rows = memory_of(side.computed);
    side.to_rows = dnnl::reorder({device_.engine, blocks, device_.engine, side.computed});
    side.to_blocks = dnnl::reorder({device_.engine, side.computed, device_.engine, blocks});
    return side;
}

template <class Number>
memory Convolution<Number>::rows_of(const Side& side) const {
    return memory_of(side.computed, (device_.*side.scratch).get_data_handle());
}

template <class Number>
memory Convolution<Number>::room(const Side& side, Number* place) const {
    return side.scratch ? rows_of(side) : memory_of(side.blocks, place);
}

template <class Number>
memory Convolution<Number>::fetch(const Side& side, Number* place) const {
    auto computed = room(side, place);
    if (!side.scratch) return computed;
    auto blocks = memory_of(side.blocks, place);
    side.to_rows.execute(device_.stream, blocks, computed);
    return computed;
}

template <class Number>
void Convolution<Number>::store(const Side& side, memory computed, Number* place) const {
    if (!side.scratch) return;
    auto blocks = memory_of(side.blocks, place);
    side.to_blocks.execute(device_.stream, computed, blocks);
}

template <class Number>
void Convolution<Number>::load(const float* kernel, const float* bias) {
    auto* const plain = static_cast<float*>(plain_.get_data_handle());
    std::fill_n(plain, outputs_ * filled_row_, 0.0f);
    for (std::size_t out = 0; out < outputs_; ++out)
        std::copy_n(kernel + out * row_, row_, plain + out * filled_row_);
    to_forward_.execute(device_.stream, plain_, forward_kernel_);
    to_backward_.execute(device_.stream, plain_, backward_kernel_);
    if (bias)
        std::copy_n(bias, bias_.get_size() / sizeof(float),
                    static_cast<float*>(bias_values_.get_data_handle()));
}

template <class Number>
void Convolution<Number>::forward(Number* x, Number* y) {
    const auto written = room(y_, y);
    std::unordered_map<int, memory> arguments = {
        {DNNL_ARG_SRC, fetch(x_, x)}, {DNNL_ARG_WEIGHTS, forward_kernel_}, {DNNL_ARG_DST, written}};
    if (bias_values_) arguments[DNNL_ARG_BIAS] = bias_values_;
    forward_.execute(device_.stream, arguments);
    store(y_, written, y);
}

template <class Number>
void Convolution<Number>::backward_data(Number* y_gradient, Number* x_gradient) {
    const auto written = room(x_, x_gradient);
    backward_data_.execute(device_.stream, {{DNNL_ARG_DIFF_DST, fetch(y_, y_gradient)},
                                            {DNNL_ARG_WEIGHTS, backward_kernel_},
                                            {DNNL_ARG_DIFF_SRC, written}});
    store(x_, written, x_gradient);
}

template <class Number>
void Convolution<Number>::backward_weights(Number* x, Number* y_gradient) {
    backward_weights_.execute(device_.stream, {{DNNL_ARG_SRC, fetch(x_, x)},
                                               {DNNL_ARG_DIFF_DST, fetch(y_, y_gradient)},
                                               {DNNL_ARG_DIFF_WEIGHTS, gradient_}});
    const auto* const gradient = static_cast<const float*>(gradient_.get_data_handle());
    for (std::size_t i = 0; i < sum_.size(); ++i) sum_[i] += gradient[i];
}

template <class Number>
void Convolution<Number>::collect(float* kernel) {
    std::copy(sum_.begin(), sum_.end(), static_cast<float*>(gradient_.get_data_handle()));
    to_plain_.execute(device_.stream, gradient_, plain_);
    const auto* const plain = static_cast<const float*>(plain_.get_data_handle());
    for (std::size_t out = 0; out < outputs_; ++out)
        for (std::size_t i = 0; i < row_; ++i)
            kernel[out * row_ + i] += plain[out * filled_row_ + i];
    std::fill(sum_.begin(), sum_.end(), 0.0f);
}

template bool by_rows<float>();
template bool by_rows<Bf16>();
template class Convolution<float>;
template class Convolution<Bf16>;

}  // namespace nn::training
