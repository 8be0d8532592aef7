#include <algorithm>
#include <cassert>

#include "nn/training/operations.h"
#include "nn/training/trainer.h"
#include "nn/training/unfuse.h"

namespace nn::training {

namespace {

class ReferenceTrainer : public Trainer {
   public:
    explicit ReferenceTrainer(const Graph& graph)
        : graph_(unfuse(graph)), parameters_(graph_), gradients_(parameters_.size()) {
        for (const auto& node : graph_.nodes) rules_.push_back(rule_of(node.operation));
    }

    void load(std::span<const float> row) override {
        assert(row.size() == parameters_.size());
        weights_.assign(row.begin(), row.end());
    }

    void forward(const Batch& batch, Statistics statistics) override {
        prepare(batch.size, batch.board);
        tape_->learning = statistics == Statistics::of_batch;
        std::size_t input = 0;
        for (int n = 0; n < node_count(); ++n) {
            auto& value = tape_->values[at(n)];
            if (tape_->node(n).operation == Operation::input) {
                const auto from = batch.inputs[input++];
                assert(from.size() == value.size());
                std::copy(from.begin(), from.end(), value.begin());
            }
            rules_[at(n)].forward(*tape_, n);
        }
        for (std::size_t o = 0; o < batch.outputs.size(); ++o) {
            const auto& value = tape_->values[at(graph_.outputs[o].node)];
            if (batch.outputs[o].empty()) continue;
            assert(batch.outputs[o].size() == value.size());
            std::copy(value.begin(), value.end(), batch.outputs[o].begin());
        }
    }

    void backward(std::span<const std::span<const float>> output_gradients) override {
        for (auto& gradient : tape_->gradients) std::fill(gradient.begin(), gradient.end(), 0.0f);
        for (std::size_t o = 0; o < output_gradients.size(); ++o) {
            auto& sum = tape_->gradients[at(graph_.outputs[o].node)];
            const auto part = output_gradients[o];
            for (std::size_t i = 0; i < std::min(part.size(), sum.size()); ++i) sum[i] += part[i];
        }
        for (int n = node_count(); n-- > 0;) rules_[at(n)].backward(*tape_, n);
    }

    void collect(std::span<float> row) override {
        for (std::size_t i = 0; i < row.size(); ++i) row[i] += gradients_[i];
        std::fill(gradients_.begin(), gradients_.end(), 0.0f);
    }

   private:
    int node_count() const { return static_cast<int>(graph_.nodes.size()); }

    void prepare(int size, int board) {
        if (!tape_ || tape_->size != size || tape_->board != board) {
            tape_ = std::make_unique<Tape>(graph_, parameters_, size, board);
            for (int n = 0; n < node_count(); ++n) tape_->reserve(n);
        }
        tape_->weights = weights_;
        tape_->weight_gradients = gradients_;
    }

    Graph graph_;
    Parameters parameters_;
    std::vector<Rule> rules_;
    std::vector<float> weights_, gradients_;
    std::unique_ptr<Tape> tape_;
};

}  // namespace

std::unique_ptr<Trainer> make_reference_trainer(const Graph& graph) {
    return std::make_unique<ReferenceTrainer>(graph);
}

}  // namespace nn::training
