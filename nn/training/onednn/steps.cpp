#include "nn/training/onednn/steps.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace nn::training {

// --- convolution

template <class Number, class Kernel>
ConvolutionStep<Number, Kernel>::ConvolutionStep(Blocked<Number>& blocked, int n)
    : blocked_(blocked),
      n_(n),
      x_(blocked.tape.input(n, 0)),
      biased_(blocked.tape.node(n).weights.size() > 1),
      convolution_(kernel()) {
    if (std::is_same_v<Number, Bf16> && !by_rows<Number>())
        paired_.emplace(blocked.extent(x_), blocked.extent(n_), side(), blocked.tape.board);
}

template <class Number, class Kernel>
Kernel ConvolutionStep<Number, Kernel>::kernel() const {
    const auto& tape = blocked_.tape;
    const auto x = blocked_.extent(x_);
    if constexpr (std::is_same_v<Kernel, TiledConvolution>)
        return Kernel(x, blocked_.extent(n_), side(), tape.board);
    else
        return Kernel(blocked_.device, tape.node(n_), x, tape.board);
}

template <class Number, class Kernel>
void ConvolutionStep<Number, Kernel>::load() {
    const auto& tape = blocked_.tape;
    convolution_.load(tape.weight(n_, 0).data(), biased_ ? tape.weight(n_, 1).data() : nullptr);
}

template <class Number, class Kernel>
void ConvolutionStep<Number, Kernel>::forward() {
    convolution_.forward(blocked_.value(x_), blocked_.value(n_));
}

template <class Number, class Kernel>
void ConvolutionStep<Number, Kernel>::backward() {
    auto* const gradient = blocked_.gradient(n_);
    if constexpr (std::is_same_v<Number, Bf16>)
        if (paired_) paired_->add(blocked_.value(x_), gradient);
    if (!paired_) convolution_.backward_weights(blocked_.value(x_), gradient);
    blocked_.give_gradient(x_, [&](Number* place) { convolution_.backward_data(gradient, place); });
    if (!biased_) return;
    const auto extent = blocked_.extent(n_);
    std::vector<float> sums(at(extent.blocks() * lanes)), squares(sums.size());
    blocked_.loops.moments(extent, gradient, sums.data(), squares.data());
    auto bias = blocked_.tape.weight_gradient(n_, 1);
    for (Eigen::Index c = 0; c < bias.rows(); ++c) bias(c, 0) += sums[static_cast<std::size_t>(c)];
}

template <class Number, class Kernel>
void ConvolutionStep<Number, Kernel>::collect() {
    auto* const kernel = blocked_.tape.weight_gradient(n_, 0).data();
    if (paired_)
        paired_->collect(kernel);
    else
        convolution_.collect(kernel);
}

// --- batch norm; the formulas are in nn/training/batch_norm.cpp

template <class Number>
NormStep<Number>::NormStep(Blocked<Number>& blocked, Nodes nodes)
    : blocked_(blocked), nodes_(nodes), x_(blocked.tape.input(nodes.norm, 0)) {
    for (auto* row : {&mean_, &inverse_, &scale_, &shift_})
        row->resize(at(blocked.extent(x_).blocks() * lanes));
}

template <class Number>
float NormStep<Number>::weight(int which, int channel) const {
    return blocked_.tape.weight(nodes_.norm, which)(channel, 0);
}

// Mean and 1 / deviation, of the batch while learning.
template <class Number>
void NormStep<Number>::measure() {
    auto& tape = blocked_.tape;
    const auto extent = blocked_.extent(x_);
    Row sums(mean_.size()), squares(mean_.size());
    if (tape.learning)
        blocked_.loops.moments(extent, blocked_.value(x_), sums.data(), squares.data());
    const float count = static_cast<float>(extent.samples) * static_cast<float>(extent.points);
    for (int c = 0; c < extent.channels; ++c) {
        float mean = weight(0, c), variance = weight(1, c);
        if (tape.learning) {
            mean = sums[at(c)] / count;
            const float square = squares[at(c)] / count;
            variance = std::max(square - mean * mean, 0.0f);
            tape.weight_gradient(nodes_.norm, 0)(c, 0) += mean * static_cast<float>(tape.size);
            tape.weight_gradient(nodes_.norm, 1)(c, 0) += square * static_cast<float>(tape.size);
        }
        mean_[at(c)] = mean;
        inverse_[at(c)] = 1 / std::sqrt(variance + tape.node(nodes_.norm).epsilon);
    }
}

template <class Number>
void NormStep<Number>::forward() {
    measure();
    const auto extent = blocked_.extent(x_);
    for (int c = 0; c < extent.channels; ++c) {
        scale_[at(c)] = weight(2, c) * inverse_[at(c)];
        shift_[at(c)] = weight(3, c) - mean_[at(c)] * scale_[at(c)];
    }
    blocked_.loops.normalise(extent, blocked_.value(x_), scale_.data(), shift_.data(),
                             nodes_.residual < 0 ? nullptr : blocked_.value(nodes_.residual),
                             nodes_.relu, blocked_.value(nodes_.y));
}

// With g the gradient of norm(x): dx = a g + b x + c.
template <class Number>
void NormStep<Number>::backward() {
    const auto extent = blocked_.extent(x_);
    auto* const gradient = blocked_.gradient(nodes_.y);
    if (nodes_.relu) blocked_.loops.mask(extent.count(), blocked_.value(nodes_.y), gradient);
    if (nodes_.residual >= 0)
        blocked_.give_gradient(
            nodes_.residual, [&](Number* place) { std::copy_n(gradient, extent.count(), place); });
    Row sums(mean_.size()), products(mean_.size()), b(mean_.size()), c(mean_.size());
    blocked_.loops.products(extent, blocked_.value(x_), gradient, sums.data(), products.data());
    const float count = static_cast<float>(extent.samples) * static_cast<float>(extent.points);
    for (int channel = 0; channel < extent.channels; ++channel) {
        const auto i = at(channel);
        const float product = (products[i] - mean_[i] * sums[i]) * inverse_[i];
        blocked_.tape.weight_gradient(nodes_.norm, 2)(channel, 0) += product;
        blocked_.tape.weight_gradient(nodes_.norm, 3)(channel, 0) += sums[i];
        b[i] = -scale_[i] * inverse_[i] * product / count;
        c[i] = -scale_[i] * sums[i] / count - b[i] * mean_[i];
    }
    if (!blocked_.tape.wants_gradient(x_)) return;
    const float* const abc[3] = {scale_.data(), b.data(), c.data()};
    auto& field = blocked_.fields[at(x_)];
    const bool add = std::exchange(field.written, true);
    blocked_.loops.norm_gradient(extent, blocked_.value(x_), gradient, abc, add,
                                 field.gradient.data());
}

// --- addition

template <class Number>
void AddStep<Number>::forward() {
    const auto& inputs = blocked_.tape.node(n_).inputs;
    blocked_.loops.sum(blocked_.extent(n_).count(), blocked_.value(inputs[0]),
                       blocked_.value(inputs[1]), blocked_.value(n_));
}

template <class Number>
void AddStep<Number>::backward() {
    const auto* const gradient = blocked_.gradient(n_);
    for (const int x : blocked_.tape.node(n_).inputs)
        blocked_.give_gradient(
            x, [&](Number* place) { std::copy_n(gradient, blocked_.extent(n_).count(), place); });
}

// --- relu

template <class Number>
void ReluStep<Number>::forward() {
    blocked_.loops.relu(blocked_.extent(n_).count(), blocked_.value(blocked_.tape.input(n_, 0)),
                        blocked_.value(n_));
}

template <class Number>
void ReluStep<Number>::backward() {
    const auto count = blocked_.extent(n_).count();
    auto* const gradient = blocked_.gradient(n_);
    blocked_.loops.mask(count, blocked_.value(n_), gradient);
    blocked_.give_gradient(blocked_.tape.input(n_, 0),
                           [&](Number* place) { std::copy_n(gradient, count, place); });
}

// --- between plain and blocked

template <class Number>
void BlockStep<Number>::forward() {
    blocked_.loops.block(blocked_.extent(n_), blocked_.tape.values[at(n_)].data(),
                         blocked_.value(n_));
}

template <class Number>
void BlockStep<Number>::backward() {
    if (!blocked_.tape.wants_gradient(n_)) return;
    blocked_.loops.unblock(blocked_.extent(n_), blocked_.gradient(n_),
                           blocked_.tape.gradients[at(n_)].data(), true);
}

template <class Number>
void UnblockStep<Number>::forward() {
    blocked_.loops.unblock(blocked_.extent(n_), blocked_.value(n_),
                           blocked_.tape.values[at(n_)].data(), false);
}

template <class Number>
void UnblockStep<Number>::backward() {
    blocked_.give_gradient(n_, [&](Number* place) {
        blocked_.loops.block(blocked_.extent(n_), blocked_.tape.gradients[at(n_)].data(), place);
    });
}

template class ConvolutionStep<float>;
template class ConvolutionStep<float, TiledConvolution>;
template class ConvolutionStep<Bf16>;
template class NormStep<float>;
template class NormStep<Bf16>;
template class AddStep<float>;
template class AddStep<Bf16>;
template class ReluStep<float>;
template class ReluStep<Bf16>;
template class BlockStep<float>;
template class BlockStep<Bf16>;
template class UnblockStep<float>;
template class UnblockStep<Bf16>;

}  // namespace nn::training
