#include "nn/eigen/executor.h"

#include <Eigen/Core>
#include <algorithm>
#include <cassert>

#include "nn/index.h"
#include "nn/passes.h"
#include "nn/plan.h"

namespace nn::eigen {

namespace {

using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using MatrixView = Eigen::Map<const Matrix>;
using MutableView = Eigen::Map<Matrix>;
using VectorView = Eigen::Map<const Eigen::VectorXf>;

VectorView vector_of(const Tensor& tensor) {
    return {tensor.values.data(), static_cast<Eigen::Index>(tensor.values.size())};
}

// Copies one plane shifted by (dx, dy), zeros flowing in: one row of an im2col matrix.
void shift_plane(const float* plane, float* out, int board, int dx, int dy) {
    const int left = std::max(0, -dx), right = std::min(board, board - dx);
    for (int y = 0; y < board; ++y, out += board) {
        const bool inside = y + dy >= 0 && y + dy < board;
        std::fill(out, out + board, 0.0f);
        const float* row = plane + std::ptrdiff_t{y + dy} * board;
        if (inside && left < right) std::copy(row + left + dx, row + right + dx, out + left);
    }
}

class EigenExecutor : public Executor {
   public:
    explicit EigenExecutor(std::shared_ptr<const Graph> graph) : graph_(std::move(graph)) {}

    void run(const Batch& batch) override {
        prepare(batch.board);
        for (int i = 0; i < batch.size; ++i) {
            std::size_t input = 0;
            for (std::size_t n = 0; n < graph_->nodes.size(); ++n)
                if (graph_->nodes[n].operation == Operation::input)
                    load(n, batch.inputs[input++], i);
                else
                    compute(n);
            for (std::size_t o = 0; o < batch.outputs.size(); ++o)
                if (!batch.outputs[o].empty())
                    store(at(graph_->outputs[o].node), batch.outputs[o], i);
        }
    }

   private:
    void prepare(int board) {
        if (board == board_) return;
        plan_ = plan_buffers(*graph_, board);
        board_ = board;
        points_ = board * board;
        buffers_.resize(plan_.buffer_sizes.size());
        for (std::size_t i = 0; i < buffers_.size(); ++i) buffers_[i].resize(plan_.buffer_sizes[i]);
        columns_.resize(columns_size());
    }

    std::size_t columns_size() const {
        std::size_t most = 0;
        for (const auto& node : graph_->nodes)
            if (node.operation == Operation::convolution) {
                const auto& kernel = node.weights[0].shape;
                most = std::max(most, at(kernel[1]) * at(kernel[2]) * at(kernel[3]) * at(points_));
            }
        return most;
    }

    float* result(std::size_t node) { return buffers_[at(plan_.buffers[node])].data(); }
    std::size_t size(std::size_t node) const { return plan_.shapes[node].size(points_); }
    MutableView planes(std::size_t node) {
        return {result(node), plan_.shapes[node].channels, points_};
    }
    // A vector as one column, a board as one row of points a channel.
    MutableView channels(std::size_t node) {
        return {result(node), plan_.shapes[node].channels,
                plan_.shapes[node].over_board ? points_ : 1};
    }

    void load(std::size_t n, std::span<const float> from, int position) {
        assert(from.size() >= size(n) * at(position + 1));
        std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(size(n)) * position, size(n),
                    result(n));
    }
    void store(std::size_t n, std::span<float> to, int position) {
        assert(to.size() >= size(n) * at(position + 1));
        std::copy_n(result(n), size(n),
                    to.begin() + static_cast<std::ptrdiff_t>(size(n)) * position);
    }

    void compute(std::size_t n) {
        const auto& node = graph_->nodes[n];
        switch (node.operation) {
            case Operation::input:
                break;
            case Operation::convolution:
                convolve(n);
                break;
            case Operation::dense:
                multiply(n);
                break;
            case Operation::batch_norm:
                assert(false && "batch norms are folded");
                break;
            case Operation::affine:
                channels(n) =
                    (channels(input(n, 0)).array().colwise() * vector_of(node.weights[0]).array())
                        .colwise() +
                    vector_of(node.weights[1]).array();
                break;
            case Operation::activation:
                channels(n) = channels(input(n, 0));
                break;
            case Operation::add:
                channels(n) = channels(input(n, 0)) + channels(input(n, 1));
                break;
            case Operation::add_vector:
                planes(n) = planes(input(n, 0)).colwise() + channels(input(n, 1)).col(0);
                break;
            case Operation::pool:
                pool(n);
                break;
            case Operation::squeeze_scale:
                squeeze(n);
                break;
            case Operation::flatten:
                std::copy_n(result(input(n, 0)), size(n), result(n));
                break;
            case Operation::concatenate:
                concatenate(n);
                break;
            case Operation::gather:
                for (std::size_t i = 0; i < node.table.size(); ++i)
                    result(n)[i] = result(input(n, 0))[node.table[i]];
                break;
            case Operation::point_bias:
                planes(n) = planes(input(n, 0)) + MatrixView(node.weights[0].values.data(),
                                                             node.weights[0].shape[0], points_);
                break;
        }
        finish(n);
    }

    std::size_t input(std::size_t n, std::size_t i) const { return at(graph_->nodes[n].inputs[i]); }

    void finish(std::size_t n) {
        const auto kind = graph_->nodes[n].activation;
        if (kind == Activation::identity) return;
        float* const values = result(n);
        if (kind == Activation::relu)
            for (std::size_t i = 0; i < size(n); ++i) values[i] = std::max(values[i], 0.0f);
        else
            for (std::size_t i = 0; i < size(n); ++i) values[i] = activate(kind, values[i]);
    }

    // Leaves the residual or zeros in the result, for a layer to add to.
    void start_sum(std::size_t n) {
        const auto& node = graph_->nodes[n];
        if (node.inputs.size() < 2) {
            std::fill_n(result(n), size(n), 0.0f);
        } else if (const auto* residual = result(input(n, 1)); residual != result(n)) {
            std::copy_n(residual, size(n), result(n));
        }
        if (node.weights.size() > 1) channels(n).colwise() += vector_of(node.weights[1]);
    }

    void convolve(std::size_t n) {
        const auto& kernel = graph_->nodes[n].weights[0];
        const int side = kernel.shape[2];
        const float* columns = result(input(n, 0));
        if (side > 1) columns = gather_columns(columns, kernel.shape[1], side);
        start_sum(n);
        const Eigen::Index row = Eigen::Index{kernel.shape[1]} * side * side;
        planes(n).noalias() += MatrixView(kernel.values.data(), kernel.shape[0], row) *
                               MatrixView(columns, row, points_);
    }

    const float* gather_columns(const float* source, int channel_count, int side) {
        float* out = columns_.data();
        for (int c = 0; c < channel_count; ++c)
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x, out += points_)
                    shift_plane(source + std::ptrdiff_t{c} * points_, out, board_, x - side / 2,
                                y - side / 2);
        return columns_.data();
    }

    void multiply(std::size_t n) {
        const auto& weights = graph_->nodes[n].weights[0];
        start_sum(n);
        channels(n).col(0).noalias() +=
            MatrixView(weights.values.data(), weights.shape[0], weights.shape[1]) *
            channels(input(n, 0)).col(0);
    }

    void pool(std::size_t n) {
        const auto source = planes(input(n, 0));
        const auto count = source.rows();
        const auto kind = graph_->nodes[n].pooling;
        const float side = static_cast<float>(board_) - 14;
        auto out = channels(n).col(0);
        out.head(count) = source.rowwise().mean();
        if (kind == Pooling::mean) return;
        out.segment(count, count) = out.head(count) * (side * 0.1f);
        if (kind == Pooling::mean_maximum)
            out.tail(count) = source.rowwise().maxCoeff();
        else
            out.tail(count) = out.head(count) * (side * side * 0.01f - 0.1f);
    }

    void squeeze(std::size_t n) {
        const auto source = planes(input(n, 0));
        const auto excitation = channels(input(n, 1)).col(0);
        const bool residual = graph_->nodes[n].inputs.size() > 2;
        for (Eigen::Index c = 0; c < source.rows(); ++c) {
            const float scale = activate(Activation::sigmoid, excitation[c]);
            const float shift = excitation[source.rows() + c];
            if (residual)
                planes(n).row(c) =
                    planes(input(n, 2)).row(c).array() + (source.row(c).array() * scale + shift);
            else
                planes(n).row(c) = source.row(c).array() * scale + shift;
        }
    }

    void concatenate(std::size_t n) {
        float* out = result(n);
        for (std::size_t i = 0; i < graph_->nodes[n].inputs.size(); ++i) {
            const auto part = input(n, i);
            out = std::copy_n(result(part), size(part), out);
        }
    }

    std::shared_ptr<const Graph> graph_;
    Plan plan_;
    int board_ = 0, points_ = 0;
    std::vector<std::vector<float>> buffers_;
    std::vector<float> columns_;
};

}  // namespace

Program::Program(Graph graph) : graph_(std::make_shared<const Graph>(optimise(std::move(graph)))) {}

std::unique_ptr<Executor> Program::make_executor() const {
    return std::make_unique<EigenExecutor>(graph_);
}

}  // namespace nn::eigen
