#include "nn/calibration.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "nn/backend.h"
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

void raise(std::vector<float>& maxima, std::span<const float> values, int channels) {
    const auto each = values.size() / static_cast<std::size_t>(channels);
    for (std::size_t i = 0; i < values.size(); ++i)
        maxima[i / each] = std::max(maxima[i / each], std::abs(values[i]));
}

bool sound(const std::vector<float>& maxima, const Shape& shape) {
    // How many numbers a vector holds may depend on the board.
    const bool fits =
        !shape.over_board || maxima.size() == static_cast<std::size_t>(shape.channels);
    return fits && std::all_of(maxima.begin(), maxima.end(),
                               [](float most) { return std::isfinite(most) && most >= 0; });
}

class Observer {
   public:
    explicit Observer(const Graph& graph) : graph_(laid_open(graph)) {}

    void watch(const Positions& positions) {
        if (!executor_)
            executor_ = compile(graph_, Precision::fp32, {}, positions.board)->make_executor();
        const auto shapes = infer_shapes(graph_, positions.board);
        resize(shapes, positions.board * positions.board);
        for (int i = 0; i < positions.size; ++i) {
            run(positions, i);
            for (std::size_t n = 0; n < results_.size(); ++n)
                raise(maxima_[n], results_[n], shapes[n].channels);
        }
    }
    std::vector<std::vector<float>> maxima() && { return std::move(maxima_); }

   private:
    void resize(const std::vector<Shape>& shapes, int points) {
        results_.resize(shapes.size());
        maxima_.resize(shapes.size());
        for (std::size_t n = 0; n < shapes.size(); ++n) {
            results_[n].resize(shapes[n].size(points));
            const auto channels = static_cast<std::size_t>(shapes[n].channels);
            maxima_[n].resize(std::max(maxima_[n].size(), channels));
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

NamedMaxima named_maxima(const Graph& graph, const Calibration& calibration) {
    if (calibration.maxima.empty()) return {};
    const auto optimised = optimise(graph);
    assert(optimised.nodes.size() == calibration.maxima.size());
    NamedMaxima rows;
    for (std::size_t n = 0; n < optimised.nodes.size(); ++n)
        rows[optimised.nodes[n].name] = calibration.maxima[n];
    return rows;
}

Calibration calibration_from(const Graph& graph, const NamedMaxima& rows) {
    if (rows.empty()) return {};
    const auto optimised = optimise(graph);
    const auto shapes = infer_shapes(optimised, graph.facts.board > 0 ? graph.facts.board : 9);
    Calibration calibration;
    for (std::size_t n = 0; n < optimised.nodes.size(); ++n) {
        const auto found = rows.find(optimised.nodes[n].name);
        if (found == rows.end() || !sound(found->second, shapes[n])) return {};
        calibration.maxima.push_back(found->second);
    }
    return calibration;
}

}  // namespace nn
