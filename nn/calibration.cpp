#include "nn/calibration.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "nn/eigen/executor.h"
#include "nn/passes.h"

namespace nn {

namespace {

// The optimised graph with every node as an output: optimising it again changes nothing, since a
// node that is an output is never fused away.
Graph laid_open(const Graph& graph) {
    auto open = optimise(graph);
    open.outputs.clear();
    for (std::size_t i = 0; i < open.nodes.size(); ++i)
        open.outputs.push_back({open.nodes[i].name, static_cast<int>(i)});
    return open;
}

void raise(std::vector<float>& maxima, std::span<const float> values) {
    const auto each = values.size() / maxima.size();
    for (std::size_t i = 0; i < values.size(); ++i)
        maxima[i / each] = std::max(maxima[i / each], std::abs(values[i]));
}

class Observer {
   public:
    explicit Observer(const Graph& graph)
        : graph_(laid_open(graph)), executor_(eigen::Program(graph_).make_executor()) {}

    void watch(const Positions& positions) {
        const auto shapes = infer_shapes(graph_, positions.board);
        resize(shapes, positions.board * positions.board);
        for (int i = 0; i < positions.size; ++i) {
            run(positions, i);
            for (std::size_t n = 0; n < results_.size(); ++n) raise(maxima_[n], results_[n]);
        }
    }
    std::vector<std::vector<float>> maxima() && { return std::move(maxima_); }

   private:
    void resize(const std::vector<Shape>& shapes, int points) {
        results_.resize(shapes.size());
        maxima_.resize(shapes.size());
        for (std::size_t n = 0; n < shapes.size(); ++n) {
            results_[n].resize(shapes[n].size(points));
            maxima_[n].resize(static_cast<std::size_t>(shapes[n].channels));
        }
    }

    void run(const Positions& positions, int index) {
        std::vector<std::span<const float>> inputs;
        for (const auto& all : positions.inputs) {
            const auto each = all.size() / static_cast<std::size_t>(positions.size);
            inputs.push_back(std::span(all).subspan(each * static_cast<std::size_t>(index), each));
        }
        const std::vector<std::span<float>> outputs(results_.begin(), results_.end());
        executor_->run({1, positions.board, inputs, outputs});
    }

    Graph graph_;
    std::unique_ptr<Executor> executor_;
    std::vector<std::vector<float>> results_, maxima_;
};

}  // namespace

Calibration calibrate(const Graph& graph, std::span<const Positions> batches) {
    if (batches.empty()) return {};
    Observer observer(graph);
    for (const auto& positions : batches) observer.watch(positions);
    return {std::move(observer).maxima()};
}

}  // namespace nn
