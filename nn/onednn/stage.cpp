#include "nn/onednn/stage.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace nn::onednn {

namespace {

constexpr std::array all_formats = {Format::f32, Format::bf16, Format::u8, Format::s8};

std::size_t bytes_of(Format format) {
    return format == Format::f32 ? 4 : format == Format::bf16 ? 2 : 1;
}

std::size_t at(Format format) { return static_cast<std::size_t>(format); }

}  // namespace

Stage::Stage(std::shared_ptr<const Layout> layout, PackedWeights& packed, int positions)
    : layout_(std::move(layout)), packed_(packed), positions_(positions), stream_(processor()) {
    for (const int uses : layout_->uses) values_.push_back({{}, uses});
    std::size_t input = 0;
    for (std::size_t n = 0; n < values_.size(); ++n) {
        const bool is_input = node(n).operation == Operation::input;
        const auto index = input;
        input += is_input ? 1 : 0;
        if (values_[n].uses == 0) continue;
        if (is_input)
            add_input(n, index);
        else
            add_node(n);
        release_inputs(n);
    }
    for (std::size_t i = 0; i < layout_->graph.outputs.size(); ++i) add_output(i);
}

std::vector<std::string> Stage::implementations() const {
    std::vector<std::string> names;
    for (const auto& layer : layers_) names.push_back(layer->implementation());
    return names;
}

void Stage::add_node(std::size_t n) {
    if (layout_->makers[n] == Maker::library) return add_layer(n);
    switch (node(n).operation) {
        case Operation::convolution:
        case Operation::dense:
            return add_small(n);
        case Operation::pool:
            return add_pool(n);
        case Operation::flatten:
            return add_flatten(n);
        case Operation::concatenate:
            return add_concatenate(n);
        case Operation::gather:
            return add_gather(n);
        default:
            return add_transform(n);
    }
}

void Stage::add_input(std::size_t n, std::size_t index) {
    for (const auto format : all_formats) {
        if (!wants(n, format)) continue;
        const auto& inverse = layout_->inverse_steps[n];
        const Turn turn{nullptr,
                        make(n, format),
                        format,
                        format >= Format::u8 ? inverse.data() : nullptr,
                        positions_,
                        points_of(n),
                        layout_->shapes[n].channels};
        steps_.emplace_back([turn, index](const Ends& ends) {
            auto now = turn;
            now.in = ends.inputs[index];
            kernels().to_rows(now);
        });
    }
}

void Stage::add_transform(std::size_t n) {
    const auto wanted = std::count(layout_->wanted[n].begin(), layout_->wanted[n].end(), true);
    auto format = Format::f32;
    for (const auto other : all_formats)
        if (wants(n, other)) format = other;
    auto transform = shaped(n);
    transform.in = input_f32(n, 0);
    transform.activation = node(n).activation;
    transform.format = format;
    if (format >= Format::u8) transform.post = layout_->inverse_steps[n].data();
    transform_terms(n, transform);
    transform.out = make(n, format);
    if (format != Format::f32 && wanted > 1) transform.exact = make_f32(n);
    step(transform);
    convert_rest(n);
}

void Stage::transform_terms(std::size_t n, Transform& t) {
    const auto& weights = node(n).weights;
    switch (node(n).operation) {
        case Operation::affine:
            t.scale = weights[0].values.data();
            t.shift = weights[1].values.data();
            break;
        case Operation::add:
            t.residual = input_f32(n, 1);
            break;
        case Operation::add_vector:
            t.shift = input_f32(n, 1);
            t.step = t.channels;
            break;
        case Operation::squeeze_scale:
            squeeze_terms(n, t);
            break;
        case Operation::point_bias:
            t.residual = bias_rows(n);
            break;
        default:
            assert(node(n).operation == Operation::activation);
    }
}

// A bias per point, laid out as the rows of all positions, in memory that no step writes to.
const float* Stage::bias_rows(std::size_t n) {
    const int channels = layout_->shapes[n].channels;
    const auto size = layout_->size(static_cast<int>(n));
    constants_.push_back(allocate(size * sizeof(float) * static_cast<std::size_t>(positions_)));
    auto* const rows = reinterpret_cast<float*>(constants_.back().get());
    for (int i = 0; i < positions_; ++i)
        kernels().to_rows({node(n).weights[0].values.data(),
                           rows + size * static_cast<std::size_t>(i), Format::f32, nullptr, 1,
                           layout_->points, channels});
    return rows;
}

void Stage::squeeze_terms(std::size_t n, Transform& t) {
    // Scales and shifts side by side; the scales become sigmoids elsewhere.
    const auto* const excitation = input_f32(n, 1);
    auto* const factors = reinterpret_cast<float*>(buffers_.take(
        layout_->size(static_cast<int>(source(n, 1))) * 4 * static_cast<std::size_t>(positions_)));
    for (int i = 0; i < positions_; ++i) {
        Transform sigmoid;
        sigmoid.in = excitation + std::ptrdiff_t{2} * i * t.channels;
        sigmoid.out = factors + std::ptrdiff_t{2} * i * t.channels;
        sigmoid.activation = Activation::sigmoid;
        sigmoid.positions = sigmoid.points = 1;
        sigmoid.channels = t.channels;
        step(sigmoid);
    }
    t.scale = factors;
    t.shift = excitation + t.channels;
    t.step = std::ptrdiff_t{2} * t.channels;
    if (node(n).inputs.size() > 2) t.residual = input_f32(n, 2);
}

Format Stage::layer_format(std::size_t n) const {
    const auto& wanted = layout_->wanted[n];
    if (std::count(wanted.begin(), wanted.end(), true) != 1 || node(n).inputs.size() > 1 ||
        !fuses(node(n).activation) || wants(n, Format::f32))
        return Format::f32;
    if (wants(n, Format::bf16))
        return layout_->reads[n] == Format::f32 ? Format::f32 : Format::bf16;
    const auto only = wants(n, Format::u8) ? Format::u8 : Format::s8;
    // Scales may change places with these activations alone.
    const bool scalable =
        node(n).activation == Activation::relu || node(n).activation == Activation::identity;
    return layout_->reads[n] >= Format::u8 && scalable ? only : Format::f32;
}

std::byte* Stage::sum_buffer(std::size_t n) {
    const auto residual = source(n, 1);
    auto& value = values_[residual];
    if (value.uses == 1) return std::exchange(value.data[at(Format::f32)], nullptr);
    auto copy = shaped(n);
    copy.in = input_f32(n, 1);
    auto* const bytes = make(n, Format::f32);
    copy.out = bytes;
    step(copy);
    return bytes;
}

void Stage::add_layer(std::size_t n) {
    const auto format = layer_format(n);
    const auto reads = layout_->reads[n];
    LayerCall call;
    call.node = n;
    call.layer = &node(n);
    call.positions = positions_;
    call.board = layout_->board;
    call.in = values_[source(n, 0)].data[at(reads)];
    call.in_format = reads;
    call.in_steps = &layout_->steps[source(n, 0)];
    call.out_format = format;
    call.out_inverse_steps = &layout_->inverse_steps[n];
    call.sum = node(n).inputs.size() > 1;
    auto* const out = call.sum ? sum_buffer(n) : make(n, format);
    values_[n].data[at(format)] = out;
    call.out = out;
    Node plain;
    if (!fuses(node(n).activation)) {
        plain = node(n);
        plain.activation = Activation::identity;
        call.layer = &plain;
    }
    layers_.push_back(std::make_unique<Layer>(call, packed_));
    steps_.emplace_back([this, layer = layers_.back().get()](const Ends&) { layer->run(stream_); });
    if (!fuses(node(n).activation)) {
        auto activation = shaped(n);
        activation.in = reinterpret_cast<const float*>(out);
        activation.out = out;
        activation.activation = node(n).activation;
        step(activation);
    }
    convert_rest(n);
}

void Stage::add_small(std::size_t n) {
    const auto& layer = node(n);
    Small small;
    small.in = input_f32(n, 0);
    small.weights = packed_.small(n, layer.weights[0]);
    if (layer.weights.size() > 1) small.bias = layer.weights[1].values.data();
    if (layer.inputs.size() > 1) small.residual = input_f32(n, 1);
    small.activation = layer.activation;
    small.rows = positions_ * points_of(n);
    small.ins = layer.weights[0].shape[1];
    small.outs = layer.weights[0].shape[0];
    small.out = make_f32(n);
    steps_.emplace_back([small](const Ends&) { kernels().small(small); });
    convert_rest(n);
}

void Stage::add_pool(std::size_t n) {
    const auto& shape = layout_->shapes[source(n, 0)];
    const Pool pool{input_f32(n, 0),
                    make_f32(n),
                    node(n).pooling,
                    positions_,
                    layout_->points,
                    shape.channels,
                    static_cast<float>(layout_->board)};
    steps_.emplace_back([pool](const Ends&) { kernels().pool(pool); });
    convert_rest(n);
}

void Stage::add_flatten(std::size_t n) {
    const Turn turn{input_f32(n, 0),
                    make_f32(n),
                    Format::f32,
                    nullptr,
                    positions_,
                    layout_->points,
                    layout_->shapes[source(n, 0)].channels};
    steps_.emplace_back([turn](const Ends&) { kernels().to_planes(turn); });
    convert_rest(n);
}

void Stage::add_concatenate(std::size_t n) {
    float* out = make_f32(n);
    const auto width = layout_->size(static_cast<int>(n));
    for (std::size_t i = 0; i < node(n).inputs.size(); ++i) {
        const auto* in = input_f32(n, i);
        const auto size = layout_->size(node(n).inputs[i]);
        steps_.emplace_back([=, positions = static_cast<std::size_t>(positions_)](const Ends&) {
            for (std::size_t p = 0; p < positions; ++p)
                std::copy_n(in + p * size, size, out + p * width);
        });
        out += size;
    }
    convert_rest(n);
}

void Stage::add_gather(std::size_t n) {
    const auto* in = input_f32(n, 0);
    float* const out = make_f32(n);
    const auto* const table = &node(n).table;
    const auto width = layout_->size(node(n).inputs[0]);
    steps_.emplace_back([=, positions = static_cast<std::size_t>(positions_)](const Ends&) {
        float* next = out;
        for (std::size_t p = 0; p < positions; ++p)
            for (const int index : *table)
                *next++ = in[p * width + static_cast<std::size_t>(index)];
    });
    convert_rest(n);
}

void Stage::add_output(std::size_t index) {
    const auto n = static_cast<std::size_t>(layout_->graph.outputs[index].node);
    const Turn turn{reinterpret_cast<const float*>(values_[n].data[at(Format::f32)]),
                    nullptr,
                    Format::f32,
                    nullptr,
                    positions_,
                    points_of(n),
                    layout_->shapes[n].channels};
    steps_.emplace_back([turn, index](const Ends& ends) {
        auto now = turn;
        now.out = ends.outputs[index];
        if (now.out != nullptr) kernels().to_planes(now);
    });
}

void Stage::convert_rest(std::size_t n) {
    const auto& data = values_[n].data;
    for (const auto format : all_formats) {
        if (!wants(n, format) || data[at(format)] != nullptr) continue;
        assert(data[at(Format::f32)] != nullptr);
        auto convert = shaped(n);
        convert.in = reinterpret_cast<const float*>(data[at(Format::f32)]);
        convert.out = make(n, format);
        convert.format = format;
        if (format >= Format::u8) convert.post = layout_->inverse_steps[n].data();
        step(convert);
    }
}

void Stage::release_inputs(std::size_t n) {
    for (const int input : node(n).inputs) {
        auto& value = values_[static_cast<std::size_t>(input)];
        if (--value.uses > 0) continue;
        for (auto*& data : value.data)
            if (data != nullptr) buffers_.give_back(std::exchange(data, nullptr));
    }
}

void Stage::step(const Transform& transform) {
    steps_.emplace_back([transform](const Ends&) { kernels().transform(transform); });
}

Transform Stage::shaped(std::size_t n) const {
    Transform transform;
    transform.positions = positions_;
    transform.points = points_of(n);
    transform.channels = layout_->shapes[n].channels;
    return transform;
}

std::byte* Stage::make(std::size_t n, Format format) {
    auto*& data = values_[n].data[at(format)];
    assert(data == nullptr);
    return data = buffers_.take(layout_->size(static_cast<int>(n)) *
                                static_cast<std::size_t>(positions_) * bytes_of(format));
}

const float* Stage::input_f32(std::size_t n, std::size_t i) const {
    const auto* data = values_[source(n, i)].data[at(Format::f32)];
    assert(data != nullptr);
    return reinterpret_cast<const float*>(data);
}

}  // namespace nn::onednn
