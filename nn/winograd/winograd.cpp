#include "nn/winograd/winograd.h"

#include "engine/base/error.h"
#include "nn/index.h"
#include "nn/winograd/lowering.h"

namespace nn::winograd {

namespace {

constexpr int least_board = 2, most_board = 32;

class WinogradExecutor : public Executor {
   public:
    explicit WinogradExecutor(std::shared_ptr<const Lowered> lowered)
        : lowered_(std::move(lowered)), space_(*lowered_->kernels, lowered_->layout) {
        space_.inputs.resize(lowered_->input_sizes.size());
    }

    // Depth first: a few positions through all layers, then the next.
    void run(const Batch& batch) override {
        const auto& layout = lowered_->layout;
        if (batch.board != layout.board.side)
            engine::fail("the network was prepared for a board of {}, found {}", layout.board.side,
                         batch.board);
        int parts = (batch.size + layout.positions - 1) / layout.positions;
        for (int begin = 0; begin < batch.size; --parts) {
            space_.positions = (batch.size - begin + parts - 1) / parts;
            for (std::size_t i = 0; i < space_.inputs.size(); ++i)
                space_.inputs[i] = batch.inputs[i].data() + at(begin) * lowered_->input_sizes[i];
            for (const auto& step : lowered_->steps) step->run(space_);
            for (std::size_t o = 0; o < batch.outputs.size(); ++o)
                if (!batch.outputs[o].empty()) store(lowered_->outputs[o], batch.outputs[o], begin);
            begin += space_.positions;
        }
    }

   private:
    void store(const Result& result, std::span<float> to, int begin) const {
        const int points = result.over_board ? lowered_->layout.points() : 1;
        float* out = to.data() + at(begin) * at(result.channels) * at(points);
        for (int p = 0; p < space_.positions; ++p)
            if (result.over_board)
                out = store_board(result, p, out);
            else
                out = std::copy_n(space_.vector(result.buffer, p), result.channels, out);
    }
    float* store_board(const Result& result, int position, float* out) const {
        const int points = lowered_->layout.points(), stride = padded(result.channels);
        const float* from =
            space_.board(result.buffer) + std::ptrdiff_t{position} * points * stride;
        for (int c = 0; c < result.channels; ++c)
            for (int p = 0; p < points; ++p) *out++ = from[p * stride + c];
        return out;
    }

    std::shared_ptr<const Lowered> lowered_;
    Workspace space_;
};

bool serves_convolution(const Graph& graph, const Node& node) {
    const int side = node.weights[0].shape[2];
    return graph.nodes[at(node.inputs[0])].operation == Operation::input || side == 1 || side == 3;
}

bool reads_input_board(const Graph& graph, const std::vector<Shape>& shapes, const Node& node) {
    for (std::size_t i = 0; i < node.inputs.size(); ++i) {
        const int input = node.inputs[i];
        if (graph.nodes[at(input)].operation == Operation::input && shapes[at(input)].over_board &&
            (node.operation != Operation::convolution || i > 0))
            return true;
    }
    return false;
}

bool serves_node(const Graph& graph, const std::vector<Shape>& shapes, std::size_t n) {
    const auto& node = graph.nodes[n];
    if (reads_input_board(graph, shapes, node)) return false;
    if (shapes[n].over_board && !curve_of(node.activation)) return false;
    switch (node.operation) {
        case Operation::convolution:
            return serves_convolution(graph, node);
        case Operation::dense:
            return node.inputs.size() == 1;
        case Operation::batch_norm:
            return false;
        default:
            return true;
    }
}

}  // namespace

bool available() { return best_kernels() != nullptr; }

bool serves(const Graph& optimised, int board) {
    if (board < least_board || board > most_board) return false;
    const auto shapes = infer_shapes(optimised, board);
    bool tower = false;
    for (std::size_t n = 0; n < optimised.nodes.size(); ++n) {
        if (!serves_node(optimised, shapes, n)) return false;
        tower = tower || (optimised.nodes[n].operation == Operation::convolution &&
                          optimised.nodes[n].weights[0].shape[2] == 3);
    }
    for (const auto& output : optimised.outputs)
        if (optimised.nodes[at(output.node)].operation == Operation::input) return false;
    return tower;
}

Program::Program(const Graph& optimised, std::span<const std::vector<float>> maxima, int board,
                 const Kernels* kernels)
    : lowered_(std::make_shared<const Lowered>(lower(optimised, maxima, board, *kernels))) {}

std::unique_ptr<Executor> Program::make_executor() const {
    return std::make_unique<WinogradExecutor>(lowered_);
}

}  // namespace nn::winograd
