#include "nn/training/onednn/trainer.h"

#include <algorithm>
#include <cassert>
#include <map>

#include "nn/training/onednn/compile.h"
#include "nn/training/unfuse.h"

namespace nn::training {

namespace {

// All that depends on batch size and board.
template <class Number>
struct Pass {
    Pass(const Graph& graph, const Parameters& parameters, Device& device, int size, int board)
        : tape(graph, parameters, size, board),
          blocked{tape, device, loops<Number>()},
          steps(compile_steps(blocked)) {}

    Tape tape;
    Blocked<Number> blocked;
    std::vector<std::unique_ptr<Step>> steps;
    long loaded = -1;  // which weights its steps have
};

template <class Number>
class OneDnnTrainer : public Trainer {
   public:
    explicit OneDnnTrainer(const Graph& graph)
        : graph_(unfuse(graph)), parameters_(graph_), gradients_(parameters_.size()) {
        onednn::use_callers_thread();
    }

    void load(std::span<const float> row) override {
        assert(row.size() == parameters_.size());
        weights_.assign(row.begin(), row.end());
        ++version_;
    }

    void forward(const Batch& batch, Statistics statistics) override {
        prepare(batch.size, batch.board);
        auto& tape = pass_->tape;
        tape.learning = statistics == Statistics::of_batch;
        const auto inputs = graph_.input_nodes();
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            assert(batch.inputs[i].size() == tape.count(inputs[i]));
            std::copy(batch.inputs[i].begin(), batch.inputs[i].end(),
                      tape.values[at(inputs[i])].begin());
        }
        for (auto& step : pass_->steps) step->forward();
        for (std::size_t o = 0; o < batch.outputs.size(); ++o)
            if (!batch.outputs[o].empty()) {
                const auto& value = tape.values[at(graph_.outputs[o].node)];
                std::copy(value.begin(), value.end(), batch.outputs[o].begin());
            }
    }

    void backward(std::span<const std::span<const float>> output_gradients) override {
        auto& tape = pass_->tape;
        for (auto& gradient : tape.gradients) std::fill(gradient.begin(), gradient.end(), 0.0f);
        for (auto& field : pass_->blocked.fields) field.written = false;
        for (std::size_t o = 0; o < output_gradients.size(); ++o) {
            auto& sum = tape.gradients[at(graph_.outputs[o].node)];
            const auto part = output_gradients[o];
            for (std::size_t i = 0; i < std::min(part.size(), sum.size()); ++i) sum[i] += part[i];
        }
        for (std::size_t s = pass_->steps.size(); s-- > 0;) pass_->steps[s]->backward();
    }

    void collect(std::span<float> row) override {
        for (auto& [key, pass] : passes_)
            for (auto& step : pass->steps) step->collect();
        for (std::size_t i = 0; i < row.size(); ++i) row[i] += gradients_[i];
        std::fill(gradients_.begin(), gradients_.end(), 0.0f);
    }

   private:
    void prepare(int size, int board) {
        auto& pass = passes_[{size, board}];
        if (!pass) pass = std::make_unique<Pass<Number>>(graph_, parameters_, device_, size, board);
        pass_ = pass.get();
        pass_->tape.weights = weights_;
        pass_->tape.weight_gradients = gradients_;
        if (std::exchange(pass_->loaded, version_) != version_)
            for (auto& step : pass_->steps) step->load();
    }

    Graph graph_;
    Parameters parameters_;
    Device device_;
    std::vector<float> weights_, gradients_;
    long version_ = 0;
    std::map<std::pair<int, int>, std::unique_ptr<Pass<Number>>> passes_;
    Pass<Number>* pass_ = nullptr;
};

}  // namespace

std::unique_ptr<Trainer> make_onednn_trainer(const Graph& graph, Precision precision) {
    if (precision == Precision::bf16 && onednn::has_bf16())
        return std::make_unique<OneDnnTrainer<Bf16>>(graph);
    return std::make_unique<OneDnnTrainer<float>>(graph);
}

}  // namespace nn::training
