#include "nn/index.h"
#include "nn/winograd/steps.h"

namespace nn::winograd {

std::optional<Curve> curve_of(Activation activation) {
    switch (activation) {
        case Activation::identity:
            return Curve::identity;
        case Activation::relu:
            return Curve::relu;
        case Activation::mish:
            return Curve::mish;
        case Activation::silu:
            return Curve::silu;
        case Activation::tanh:
            return Curve::tanh;
        case Activation::sigmoid:
            return Curve::sigmoid;
        case Activation::square_root:
            return Curve::square_root;
        case Activation::softplus:
            return {};
    }
    return {};
}

Finish Target::finish(const Workspace& space) const {
    Finish finish;
    finish.board = space.layout.board;
    finish.channels = channels;
    finish.word_channels = word_channels;
    finish.bias = bias.data();
    if (bias_vector >= 0) {
        finish.bias = space.biases.data();
        finish.bias_stride = channels;
        for (int p = 0; p < space.positions; ++p)
            for (int c = 0; c < channels; ++c)
                space.biases[at(p * channels + c)] =
                    bias[at(c)] + space.vector(bias_vector, p)[bias_offset + c];
    }
    if (residual >= 0) {
        finish.residual = space.board(residual);
        finish.residual_stride = std::ptrdiff_t{space.layout.points()} * channels;
    } else if (point_bias.size() > 0) {
        finish.residual = point_bias.data();
    }
    finish.first = first;
    finish.second = second;
    if (floats >= 0) finish.floats = space.board(floats);
    if (words >= 0) finish.words = space.board_of_words(words);
    finish.scale = scale.data();
    finish.shift = shift.data();
    finish.inverse_step = inverse_step.data();
    finish.lowest = lowest;
    finish.highest = highest;
    return finish;
}

TowerStep::TowerStep(int words, int word_channels, const Tensor& kernel, std::vector<Group> groups,
                     Target target)
    : words_(words),
      word_channels_(word_channels),
      pairs_(padded(kernel.shape[1]) / 2),
      groups_(std::move(groups)),
      target_(std::move(target)) {}

void TowerStep::run(Workspace& space) const {
    const auto& board = space.layout.board;
    const int rows = space.positions * board.tiles * board.tiles;
    const int cells = (board.tile + 2) * (board.tile + 2);
    // An odd number of rows, or cells would lie a multiple of 4096 bytes apart and share a few
    // places of the cache.
    const std::ptrdiff_t cell_stride = std::ptrdiff_t{rows | 1} * word_channels_;
    if (!reuse_)
        space.kernels.transform({board, space.positions, word_channels_,
                                 space.board_of_words(words_), space.transformed.data(),
                                 cell_stride});
    const auto finish = target_.finish(space);
    for (const auto& group : groups_) {
        space.kernels.multiply({space.transformed.data(), cell_stride, word_channels_, cells, rows,
                                pairs_, group.width, group.weights.data(), group.scale.data(),
                                space.products.data()});
        space.kernels.finish({space.positions, group.width, group.channel, space.products.data()},
                             finish);
    }
}

PointsStep::PointsStep(int words, int word_channels, const Tensor& kernel,
                       std::vector<Group> groups, Target target)
    : words_(words),
      word_channels_(word_channels),
      pairs_(padded(kernel.shape[1]) / 2),
      groups_(std::move(groups)),
      target_(std::move(target)) {}

void PointsStep::run(Workspace& space) const {
    const auto finish = target_.finish(space);
    for (const auto& group : groups_)
        space.kernels.points(
            {space.positions, pairs_, group.width, group.channel, word_channels_,
             space.board_of_words(words_), group.weights.data(), group.scale.data()},
            finish);
}

void PointwiseStep::run(Workspace& space) const {
    const float* scale = scale_.size() > 0 ? scale_.data() : nullptr;
    if (excitation_ >= 0) {
        for (int p = 0; p < space.positions; ++p) {
            float* to = space.scales.data() + std::ptrdiff_t{p} * target_.channels;
            std::copy_n(space.vector(excitation_, p), target_.channels, to);
            space.kernels.activate(Curve::sigmoid, to, target_.channels);
        }
        scale = space.scales.data();
    }
    space.kernels.pointwise(
        {space.positions, space.board(source_), scale, excitation_ >= 0 ? target_.channels : 0},
        target_.finish(space));
}

}  // namespace nn::winograd
