#include "nn/index.h"
#include "nn/winograd/steps.h"

namespace nn::winograd {

void PoolStep::run(Workspace& space) const {
    const int points = space.layout.points(), stride = padded(channels_);
    const float side = static_cast<float>(space.layout.board.side) - 14;
    float* const mean = space.pooled.data();
    float* const maximum = mean + stride;
    for (int p = 0; p < space.positions; ++p) {
        space.kernels.pool({points, stride,
                            space.board(source_) + std::ptrdiff_t{p} * points * stride, mean,
                            maximum});
        float* out = std::copy_n(mean, channels_, space.vector(out_, p));
        if (pooling_ == Pooling::mean) continue;
        for (int c = 0; c < channels_; ++c) *out++ = mean[c] * (side * 0.1f);
        for (int c = 0; c < channels_; ++c)
            *out++ = pooling_ == Pooling::mean_maximum ? maximum[c]
                                                       : mean[c] * (side * side * 0.01f - 0.1f);
    }
}

DenseStep::DenseStep(int source, const Node& node, int out)
    : source_(source),
      inputs_(node.weights[0].shape[1]),
      out_(out),
      weights_(pack_dense(node.weights[0])),
      bias_(pack_vector(node.weights.size() > 1
                            ? node.weights[1].values
                            : std::vector<float>(at(node.weights[0].shape[0])))) {}

void DenseStep::run(Workspace& space) const {
    space.kernels.dense({space.positions, inputs_, static_cast<int>(bias_.size()), weights_.data(),
                         bias_.data(), space.vector(source_), space.vector_stride(source_),
                         space.vector(out_), space.vector_stride(out_)});
}

void InputStep::run(Workspace& space) const {
    for (int p = 0; p < space.positions; ++p)
        std::copy_n(space.inputs[at(input_)] + std::ptrdiff_t{p} * size_, size_,
                    space.vector(out_, p));
}

void VectorStep::run(Workspace& space) const {
    for (int p = 0; p < space.positions; ++p) {
        float* out = space.vector(out_, p);
        std::fill_n(out, size_, 0.0f);
        for (const auto& part : parts_) add(space, part, p, out + part.begin);
        for (std::size_t i = 0; i < scale_.size(); ++i) out[i] = out[i] * scale_[i] + shift_[i];
    }
}

void VectorStep::add(const Workspace& space, const Part& part, int position, float* out) const {
    const float* from = part.over_board ? space.board(part.source) +
                                              at(position) * space.layout.floats[at(part.source)]
                                        : space.vector(part.source, position);
    if (part.indices.empty())
        for (int i = 0; i < part.count; ++i) out[i] += from[i];
    else
        for (std::size_t i = 0; i < part.indices.size(); ++i) out[i] += from[part.indices[i]];
}

void ActivationStep::run(Workspace& space) const {
    const auto curve = curve_of(kind_);
    for (int p = 0; p < space.positions; ++p) {
        float* values = space.vector(vector_, p);
        if (curve)
            space.kernels.activate(*curve, values, padded(size_));
        else
            for (int i = 0; i < size_; ++i) values[i] = activate(kind_, values[i]);
    }
}

}  // namespace nn::winograd
