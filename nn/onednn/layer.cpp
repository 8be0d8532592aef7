#include "nn/onednn/layer.h"

#include <cassert>

#include "nn/onednn/library.h"

namespace nn::onednn {

namespace {

using Memory = dnnl::memory;
using Algorithm = dnnl::algorithm;
using Tag = Memory::format_tag;

Memory::data_type type_of(Format format) {
    switch (format) {
        case Format::f32:
            return Memory::data_type::f32;
        case Format::bf16:
            return Memory::data_type::bf16;
        case Format::u8:
            return Memory::data_type::u8;
        case Format::s8:
            return Memory::data_type::s8;
    }
    return Memory::data_type::undef;
}

Memory::data_type weight_type(Format input) {
    return input >= Format::u8 ? Memory::data_type::s8 : type_of(input);
}

void append_activation(dnnl::post_ops& operations, Activation activation) {
    const auto append = [&](Algorithm algorithm, float alpha) {
        operations.append_eltwise(1, algorithm, alpha, 0);
    };
    switch (activation) {
        case Activation::relu:
            return append(Algorithm::eltwise_relu, 0);
        case Activation::mish:
            return append(Algorithm::eltwise_mish, 0);
        case Activation::silu:
            return append(Algorithm::eltwise_swish, 1);
        case Activation::tanh:
            return append(Algorithm::eltwise_tanh, 0);
        case Activation::sigmoid:
            return append(Algorithm::eltwise_logistic, 0);
        default:
            assert(activation == Activation::identity);
    }
}

dnnl::primitive_attr attributes_of(const LayerCall& call, const Weights& weights) {
    dnnl::primitive_attr attributes;
    dnnl::post_ops operations;
    if (call.sum) operations.append_sum(1);
    append_activation(operations, call.layer->activation);
    attributes.set_post_ops(operations);
    attributes.set_scratchpad_mode(dnnl::scratchpad_mode::user);
    auto scales = weights.scales;
    if (call.out_format >= Format::u8)
        for (std::size_t o = 0; o < scales.size(); ++o) scales[o] *= (*call.out_inverse_steps)[o];
    if (!scales.empty()) attributes.set_output_scales(2, scales);
    return attributes;
}

Memory::dims dims_of(const Tensor& tensor) { return {tensor.shape.begin(), tensor.shape.end()}; }

dnnl::convolution_forward::primitive_desc convolution_of(const LayerCall& call,
                                                         const Memory::dims& kernel,
                                                         const dnnl::primitive_attr& attributes) {
    const Memory::dim side = call.board, pad = kernel[2] / 2;
    const dnnl::convolution_forward::desc wish(
        dnnl::prop_kind::forward_inference, Algorithm::convolution_direct,
        Memory::desc({call.positions, kernel[1], side, side}, type_of(call.in_format), Tag::nhwc),
        Memory::desc(kernel, weight_type(call.in_format), Tag::any),
        Memory::desc({kernel[0]}, Memory::data_type::f32, Tag::a),
        Memory::desc({call.positions, kernel[0], side, side}, type_of(call.out_format), Tag::nhwc),
        {1, 1}, {pad, pad}, {pad, pad});
    return {wish, attributes, processor()};
}

dnnl::inner_product_forward::primitive_desc dense_of(const LayerCall& call,
                                                     const Memory::dims& weights,
                                                     const dnnl::primitive_attr& attributes) {
    const dnnl::inner_product_forward::desc wish(
        dnnl::prop_kind::forward_inference,
        Memory::desc({call.positions, weights[1]}, type_of(call.in_format), Tag::ab),
        Memory::desc(weights, weight_type(call.in_format), Tag::any),
        Memory::desc({weights[0]}, Memory::data_type::f32, Tag::a),
        Memory::desc({call.positions, weights[0]}, type_of(call.out_format), Tag::ab));
    return {wish, attributes, processor()};
}

}  // namespace

bool fuses(Activation activation) {
    return activation != Activation::softplus && activation != Activation::square_root;
}

Layer::Layer(const LayerCall& call, PackedWeights& packed) {
    static const std::vector<float> none;
    const auto weights = prepare(*call.layer, call.in_format >= Format::u8 ? *call.in_steps : none);
    const auto dims = dims_of(call.layer->weights[0]);
    const auto attributes = attributes_of(call, weights);
    if (call.layer->operation == Operation::convolution) {
        const auto descriptor = convolution_of(call, dims, attributes);
        primitive_ = dnnl::convolution_forward(descriptor);
        adopt(descriptor, call, weights, packed, dims);
    } else {
        const auto descriptor = dense_of(call, dims, attributes);
        primitive_ = dnnl::inner_product_forward(descriptor);
        adopt(descriptor, call, weights, packed, dims);
    }
}

template <class PrimitiveDescriptor>
void Layer::adopt(const PrimitiveDescriptor& descriptor, const LayerCall& call,
                  const Weights& weights, PackedWeights& packed, const Memory::dims& dims) {
    implementation_ = descriptor.impl_info_str();
    bias_ = weights.bias;
    // The library takes no pointer to const; it only reads what comes in.
    memories_ = {{descriptor.src_desc(), processor(), const_cast<void*>(call.in)},
                 packed.weights(call.node, weights, dims, descriptor.weights_desc()),
                 {descriptor.bias_desc(), processor(), bias_.data()},
                 {descriptor.dst_desc(), processor(), call.out},
                 {descriptor.scratchpad_desc(), processor()}};
    constexpr int roles[] = {DNNL_ARG_SRC, DNNL_ARG_WEIGHTS, DNNL_ARG_BIAS, DNNL_ARG_DST,
                             DNNL_ARG_SCRATCHPAD};
    for (std::size_t i = 0; i < memories_.size(); ++i)
        arguments_.push_back({roles[i], memories_[i].get()});
}

void Layer::run(const dnnl::stream& stream) const {
    [[maybe_unused]] const auto status = dnnl_primitive_execute(
        primitive_.get(), stream.get(), static_cast<int>(arguments_.size()), arguments_.data());
    assert(status == dnnl_success);
}

}  // namespace nn::onednn
