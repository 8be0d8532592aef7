#include "nn/winograd/lowering.h"

#include <cassert>
#include <cmath>

#include "nn/index.h"
#include "nn/winograd/roles.h"
#include "nn/winograd/storage.h"

namespace nn::winograd {

namespace {

// Calibration sees few positions: values may grow to this multiple before they are clipped.
constexpr float headroom = 1.5f;
// Of words that only 1x1 convolutions read: 13 bits, which leaves their weights as many.
constexpr int wide_limit = 8191;
// Positions computed together: their tiles read all weights once, and more of them would not fit
// the caches.
constexpr int most_tiles = 36, most_positions = 8;

bool negative(Activation activation) {
    return activation != Activation::relu && activation != Activation::sigmoid &&
           activation != Activation::square_root;
}

Layout layout_for(int board) {
    Layout layout;
    const int tile = best_tile(board), tiles = (board + tile - 1) / tile;
    layout.board = {board, tiles * tile + 2, tile, tiles};
    layout.positions = std::clamp(most_tiles / (tiles * tiles), 1, most_positions);
    return layout;
}

class Lowering {
   public:
    Lowering(const Graph& graph, std::span<const std::vector<float>> maxima, int board,
             const Kernels& kernels)
        : graph_(graph),
          maxima_(maxima),
          shapes_(infer_shapes(graph, board)),
          roles_(assign_roles(graph, shapes_)),
          tiling_(tiling(best_tile(board))) {
        lowered_.kernels = &kernels;
        lowered_.layout = layout_for(board);
    }

    Lowered run() {
        const Storage storage(graph_, shapes_, roles_, lowered_.layout);
        storage_ = &storage;
        measure();
        for (int n = 0; n < static_cast<int>(graph_.nodes.size()); ++n)
            if (!roles_[at(n)].hidden) lower(n);
        for (const int n : graph_.input_nodes())
            lowered_.input_sizes.push_back(shapes_[at(n)].size(lowered_.layout.points()));
        for (const auto& output : graph_.outputs) {
            const auto shape = shapes_[at(output.node)];
            lowered_.outputs.push_back(
                {storage.buffer(output.node, shape.over_board ? Form::floats : Form::vector),
                 shape.channels, shape.over_board});
        }
        return std::move(lowered_);
    }

   private:
    const Node& node(int n) const { return graph_.nodes[at(n)]; }
    int channels(int n) const { return shapes_[at(n)].channels; }
    int word_channels(int n) const { return padded(channels(n), 2 * lanes); }
    int input_number(int n) const {
        const auto inputs = graph_.input_nodes();
        return static_cast<int>(std::find(inputs.begin(), inputs.end(), n) - inputs.begin());
    }
    template <class Made>
    Made& add(Made step) {
        lowered_.steps.push_back(std::make_unique<Made>(std::move(step)));
        return static_cast<Made&>(*lowered_.steps.back());
    }

    // Sizes of the rooms that all steps share.
    void measure() {
        auto& layout = lowered_.layout;
        const auto& board = layout.board;
        const int cells = tiling_.cells(), rows = layout.positions * board.tiles * board.tiles;
        int widest = lanes;
        for (int n = 0; n < static_cast<int>(graph_.nodes.size()); ++n) {
            widest = std::max(widest, word_channels(n));
            if (node(n).operation == Operation::input && shapes_[at(n)].over_board)
                layout.entries = std::max(layout.entries, shapes_[at(n)].size(layout.points()));
            if (!shapes_[at(n)].over_board) continue;
            layout.channels = std::max(layout.channels, at(word_channels(n)));
        }
        layout.transformed = at(cells) * at(rows | 1) * layout.channels;
        layout.products = at(cells) * at(rows) * at(most_width * lanes);
    }

    // Between a scale for every channel and one for all: a channel that calibration saw quiet may
    // yet become loud.
    Quantisation quantisation(int n) const {
        const auto& seen = maxima_[at(n)];
        const int limit =
            roles_[at(n)].wide ? wide_limit : tiling_.limit(negative(node(n).activation));
        float most = *std::max_element(seen.begin(), seen.end());
        if (most <= 0) most = 1;
        Quantisation result{{}, negative(node(n).activation) ? limit : 0, limit};
        for (const float channel : seen)
            result.steps.push_back(headroom * std::sqrt(std::max(channel, 0.001f * most) * most) /
                                   static_cast<float>(limit));
        return result;
    }

    void quantise_into(Target& target, int n, const Node* affine) const {
        const auto quantisation_of = quantisation(n);
        const auto kind = *curve_of(affine ? affine->activation : Activation::identity);
        const auto count = quantisation_of.steps.size();
        std::vector<float> scale(count, 1), shift(count, 0), inverse(count);
        for (std::size_t c = 0; c < count; ++c) {
            if (affine) {
                scale[c] = affine->weights[0].values[c];
                shift[c] = affine->weights[1].values[c];
            }
            inverse[c] = 1 / quantisation_of.steps[c];
            if (kind > Curve::relu) continue;
            scale[c] *= inverse[c];
            shift[c] *= inverse[c];
        }
        target.second = kind;
        target.scale = pack_vector(scale);
        target.shift = pack_vector(shift);
        target.inverse_step = pack_vector(inverse);
        target.lowest = -static_cast<float>(quantisation_of.low);
        target.highest = static_cast<float>(quantisation_of.high);
        target.words = storage_->buffer(n, Form::words);
    }

    Target target(int n, const std::vector<float>& bias) const {
        Target target;
        target.channels = padded(channels(n));
        target.word_channels = word_channels(n);
        target.bias = pack_vector(bias.empty() ? std::vector<float>(at(channels(n))) : bias);
        target.first = *curve_of(node(n).activation);
        target.floats = storage_->buffer(n, Form::floats);
        if (roles_[at(n)].words) quantise_into(target, n, nullptr);
        const int affine = roles_[at(n)].affine;
        if (affine >= 0) quantise_into(target, affine, &node(affine));
        return target;
    }

    void lower(int n) {
        const int carrier = roles_[at(n)].carrier;
        switch (kind_of(graph_, shapes_, carrier >= 0 ? carrier : n)) {
            case Kind::first:
            case Kind::tower:
            case Kind::points:
                return convolution(n, carrier >= 0 ? carrier : n);
            case Kind::pointwise:
                return pointwise(n);
            case Kind::pool:
                add(PoolStep(storage_->buffer(node(n).inputs[0], Form::floats),
                             channels(node(n).inputs[0]), node(n).pooling,
                             storage_->buffer(n, Form::vector)));
                return activate_vector(n);
            case Kind::dense:
                add(DenseStep(storage_->buffer(node(n).inputs[0], Form::vector), node(n),
                              storage_->buffer(n, Form::vector)));
                return activate_vector(n);
            case Kind::numbers:
                return numbers(n);
        }
    }

    // `layer` is n itself or the convolution that n, an addition of a vector, is carried by.
    void convolution(int n, int layer) {
        const auto& what = node(layer);
        const auto& kernel = what.weights[0];
        auto where =
            target(n, what.weights.size() > 1 ? what.weights[1].values : std::vector<float>{});
        if (layer != n) where.bias_vector = storage_->buffer(node(n).inputs[1], Form::vector);
        if (what.inputs.size() > 1) where.residual = storage_->buffer(what.inputs[1], Form::floats);
        const int source = what.inputs[0];
        const auto kind = kind_of(graph_, shapes_, layer);
        if (kind == Kind::first) {
            add(FirstStep(input_number(source), kernel, std::move(where)));
            return;
        }
        const bool tower = kind == Kind::tower;
        const int words = storage_->buffer(source, Form::words);
        auto groups = pack_convolution(kernel, quantisation(source), tower ? &tiling_ : nullptr,
                                       lowered_.kernels->width);
        if (!tower) {
            add(PointsStep(words, word_channels(source), kernel, std::move(groups),
                           std::move(where)));
            return;
        }
        auto& step = add(
            TowerStep(words, word_channels(source), kernel, std::move(groups), std::move(where)));
        if (transformed_ == source) step.reuse_transform();
        transformed_ = source;
    }

    void pointwise(int n) {
        const auto& what = node(n);
        const auto operation = what.operation;
        auto where = target(
            n, operation == Operation::affine ? what.weights[1].values : std::vector<float>{});
        if (operation == Operation::add_vector || operation == Operation::squeeze_scale)
            where.bias_vector = storage_->buffer(what.inputs[1], Form::vector);
        if (operation == Operation::squeeze_scale) where.bias_offset = channels(n);
        const std::size_t residual = operation == Operation::squeeze_scale ? 2 : 1;
        if (what.inputs.size() > residual && operation != Operation::add_vector)
            where.residual = storage_->buffer(what.inputs[residual], Form::floats);
        if (operation == Operation::point_bias) where.point_bias = point_bias(what.weights[0]);
        PointwiseStep step(storage_->buffer(what.inputs[0], Form::floats), std::move(where));
        if (operation == Operation::affine) step.scale_by(pack_vector(what.weights[0].values));
        if (operation == Operation::squeeze_scale)
            step.excite_by(storage_->buffer(what.inputs[1], Form::vector));
        add(std::move(step));
    }

    static Buffer<float> point_bias(const Tensor& bias) {
        const int count = bias.shape[0], points = bias.shape[1];
        Buffer<float> packed(at(points) * at(padded(count)));
        for (int c = 0; c < count; ++c)
            for (int p = 0; p < points; ++p)
                packed[at(p * padded(count) + c)] = bias.values[at(c * points + p)];
        return packed;
    }

    void numbers(int n) {
        const auto& what = node(n);
        const int out = storage_->buffer(n, Form::vector);
        if (what.operation == Operation::input) {
            add(InputStep(input_number(n), channels(n), out));
            return;
        }
        std::vector<VectorStep::Part> parts;
        int begin = 0;
        for (const int input : what.inputs) {
            parts.push_back(part(input, what));
            parts.back().begin = begin;
            if (what.operation == Operation::concatenate) begin += channels(input);
        }
        auto& step = add(VectorStep(std::move(parts), channels(n), out));
        if (what.operation == Operation::affine)
            step.scale_and_shift(what.weights[0].values, what.weights[1].values);
        activate_vector(n);
    }

    // One input of an operation on vectors: all of it, or what a gather picks. A board, or a
    // flatten that has no step of its own, is read channel after channel.
    VectorStep::Part part(int input, const Node& reader) const {
        VectorStep::Part part;
        part.count = channels(input);
        const bool gathers = reader.operation == Operation::gather;
        if (gathers) part.indices = reader.table;
        const int board = roles_[at(input)].hidden ? node(input).inputs[0] : input;
        part.over_board = shapes_[at(board)].over_board;
        part.source = storage_->buffer(board, part.over_board ? Form::floats : Form::vector);
        if (!part.over_board) return part;
        const int points = lowered_.layout.points(), stride = padded(channels(board));
        if (!gathers)
            for (int i = 0; i < channels(board) * points; ++i) part.indices.push_back(i);
        for (int& index : part.indices) index = index % points * stride + index / points;
        return part;
    }

    void activate_vector(int n) {
        if (node(n).activation != Activation::identity)
            add(ActivationStep(storage_->buffer(n, Form::vector), channels(n), node(n).activation));
    }

    const Graph& graph_;
    std::span<const std::vector<float>> maxima_;
    std::vector<Shape> shapes_;
    std::vector<Role> roles_;
    const Tiling& tiling_;
    const Storage* storage_ = nullptr;
    int transformed_ = -1;  // whose words the last 3x3 convolution transformed
    Lowered lowered_;
};

}  // namespace

Lowered lower(const Graph& optimised, std::span<const std::vector<float>> maxima, int board,
              const Kernels& kernels) {
    return Lowering(optimised, maxima, board, kernels).run();
}

}  // namespace nn::winograd
