#include "nn/training/onednn/compile.h"

#include <algorithm>
#include <type_traits>

#include "nn/onednn/library.h"

namespace nn::training {

namespace {

template <class Number>
class Compiler {
   public:
    explicit Compiler(Blocked<Number>& blocked)
        : blocked_(blocked),
          tape_(blocked.tape),
          readers_(tape_.graph.nodes.size()),
          absorbed_(readers_.size()) {
        for (int n = 0; n < count(); ++n)
            for (const int input : tape_.node(n).inputs) readers_[at(input)].push_back(n);
        for (const auto& output : tape_.graph.outputs) readers_[at(output.node)].push_back(-1);
    }

    std::vector<std::unique_ptr<Step>> run() {
        blocked_.fields.resize(readers_.size());
        std::size_t most = 0;
        for (int n = 0; n < count(); ++n) {
            if (tape_.shapes[at(n)].over_board) most = std::max(most, blocked_.extent(n).count());
            if (!absorbed_[at(n)]) append(n);
        }
        for (const auto& output : tape_.graph.outputs) ensure_plain(output.node);
        blocked_.scratch.resize(most);
        return std::move(steps_);
    }

   private:
    int count() const { return static_cast<int>(tape_.graph.nodes.size()); }

    void append(int n) {
        const auto& node = tape_.node(n);
        const bool over_board = tape_.shapes[at(n)].over_board;
        if (node.operation == Operation::input)
            tape_.reserve(n);
        else if (node.operation == Operation::convolution)
            append_convolution(n);
        else if (node.operation == Operation::batch_norm && over_board)
            append_norm(n);
        else if (node.operation == Operation::add && over_board)
            append_blocked<AddStep<Number>>(n);
        else if (node.activation == Activation::relu && over_board)
            append_blocked<ReluStep<Number>>(n);
        else
            append_plain(n);
    }

    void append_convolution(int n) {
        if constexpr (std::is_same_v<Number, float>)
            if (!onednn::has_avx512())
                return append_blocked<ConvolutionStep<float, TiledConvolution>>(n);
        append_blocked<ConvolutionStep<Number>>(n);
    }

    template <class Kind>
    void append_blocked(int n) {
        for (const int input : tape_.node(n).inputs) ensure_blocked(input);
        blocked_.reserve(n);
        steps_.push_back(std::make_unique<Kind>(blocked_, n));
    }

    void append_plain(int n) {
        for (const int input : tape_.node(n).inputs) ensure_plain(input);
        tape_.reserve(n);
        steps_.push_back(std::make_unique<PlainStep>(tape_, n));
    }

    // With the addition and the relu that follow, when nothing else reads what is between.
    void append_norm(int n) {
        typename NormStep<Number>::Nodes nodes{n, -1, n, false};
        if (const int add = only_reader(n, Operation::add); add >= 0) {
            const auto& inputs = tape_.node(add).inputs;
            const int other = inputs[0] == n ? inputs[1] : inputs[0];
            if (other < n) nodes = {n, other, absorb(add), false};
        }
        if (const int relu = only_reader(nodes.y, Operation::activation);
            relu >= 0 && tape_.node(relu).activation == Activation::relu)
            nodes = {n, nodes.residual, absorb(relu), true};
        ensure_blocked(tape_.input(n, 0));
        if (nodes.residual >= 0) ensure_blocked(nodes.residual);
        blocked_.reserve(nodes.y);
        steps_.push_back(std::make_unique<NormStep<Number>>(blocked_, nodes));
    }

    int only_reader(int n, Operation operation) const {
        const auto& readers = readers_[at(n)];
        if (readers.size() != 1 || readers[0] < 0) return -1;
        return tape_.node(readers[0]).operation == operation ? readers[0] : -1;
    }

    int absorb(int n) {
        absorbed_[at(n)] = true;
        return n;
    }

    void ensure_plain(int n) {
        if (!tape_.values[at(n)].empty()) return;
        tape_.reserve(n);
        steps_.push_back(std::make_unique<UnblockStep<Number>>(blocked_, n));
    }

    void ensure_blocked(int n) {
        if (blocked_.has(n)) return;
        blocked_.reserve(n);
        steps_.push_back(std::make_unique<BlockStep<Number>>(blocked_, n));
    }

    Blocked<Number>& blocked_;
    Tape& tape_;
    std::vector<std::vector<int>> readers_;  // per node; -1 an output
    std::vector<bool> absorbed_;
    std::vector<std::unique_ptr<Step>> steps_;
};

}  // namespace

template <class Number>
std::vector<std::unique_ptr<Step>> compile_steps(Blocked<Number>& blocked) {
    return Compiler<Number>(blocked).run();
}

template std::vector<std::unique_ptr<Step>> compile_steps(Blocked<float>& blocked);
template std::vector<std::unique_ptr<Step>> compile_steps(Blocked<Bf16>& blocked);

}  // namespace nn::training
