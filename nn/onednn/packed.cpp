#include "nn/onednn/packed.h"

#include <algorithm>
#include <cmath>

#include "nn/onednn/library.h"

namespace nn::onednn {

namespace {

// One output's weights as whole numbers up to 127; yields what one is worth.
float quantise(std::span<const float> row, signed char* out) {
    float most = 1e-12f;
    for (const float weight : row) most = std::max(most, std::abs(weight));
    const float step = most / 127;
    for (const float weight : row) *out++ = static_cast<signed char>(std::lround(weight / step));
    return step;
}

}  // namespace

Weights prepare(const Node& layer, const std::vector<float>& steps) {
    const auto& kernel = layer.weights[0];
    const auto outs = static_cast<std::size_t>(kernel.shape[0]);
    Weights out{kernel.values, {}, std::vector<float>(outs), {}};
    if (layer.weights.size() > 1) out.bias = layer.weights[1].values;
    if (steps.empty()) return out;
    const auto row = out.values.size() / outs, each = row / steps.size();
    for (std::size_t i = 0; i < out.values.size(); ++i) out.values[i] *= steps[i % row / each];
    out.whole.resize(out.values.size());
    for (std::size_t o = 0; o < outs; ++o)
        out.scales.push_back(
            quantise(std::span(out.values).subspan(o * row, row), out.whole.data() + o * row));
    // The library adds the bias before it scales.
    for (std::size_t o = 0; o < outs; ++o) out.bias[o] /= out.scales[o];
    return out;
}

dnnl::memory PackedWeights::weights(std::size_t node, const Weights& weights,
                                    const dnnl::memory::dims& dims,
                                    const dnnl::memory::desc& wanted) {
    using Tag = dnnl::memory::format_tag;
    const std::lock_guard lock(mutex_);
    auto& kept = packed_[node];
    for (const auto& memory : kept)
        if (memory.get_desc() == wanted) return memory;
    const bool whole = !weights.whole.empty();
    const dnnl::memory::desc plain(
        dims, whole ? dnnl::memory::data_type::s8 : dnnl::memory::data_type::f32,
        dims.size() == 4 ? Tag::oihw : Tag::oi);
    // The library takes no pointer to const, and only reads.
    void* data = whole ? static_cast<void*>(const_cast<signed char*>(weights.whole.data()))
                       : const_cast<float*>(weights.values.data());
    dnnl::memory from(plain, processor(), data), to(wanted, processor());
    dnnl::stream stream(processor());
    dnnl::reorder(from, to).execute(stream, from, to);
    stream.wait();
    kept.push_back(to);
    return to;
}

const float* PackedWeights::small(std::size_t node, const Tensor& weights) {
    const std::lock_guard lock(mutex_);
    auto& packed = small_[node];
    if (!packed.empty()) return packed.data();
    const auto outs = static_cast<std::size_t>(weights.shape[0]);
    const auto ins = weights.values.size() / outs;
    if (outs == 1) return (packed = weights.values).data();
    const auto blocks = (outs + small_block - 1) / small_block;
    packed.resize(blocks * small_block * ins);
    for (std::size_t o = 0; o < outs; ++o)
        for (std::size_t i = 0; i < ins; ++i)
            packed[(o / small_block * ins + i) * small_block + o % small_block] =
                weights.values[o * ins + i];
    return packed.data();
}

}  // namespace nn::onednn
