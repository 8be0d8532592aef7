#include "nn/training/norms.h"

#include "nn/passes.h"

namespace nn::training {

namespace {

// `norm` computes what it did, by the statistics of `observed`.
void adopt_statistics(Node& norm, const Node& observed) {
    auto &mean = norm.weights[0].values, &scale = norm.weights[2].values,
         &shift = norm.weights[3].values;
    for (std::size_t c = 0; c < scale.size(); ++c) {
        const double slope = scale[c] / deviation(norm, c);
        const double moved = double{observed.weights[0].values[c]} - double{mean[c]};
        scale[c] = static_cast<float>(slope * deviation(observed, c));
        shift[c] = static_cast<float>(shift[c] + slope * moved);
    }
    norm.weights[0] = observed.weights[0];
    norm.weights[1] = observed.weights[1];
}

}  // namespace

Graph fit_norms(Graph graph, const Samples& samples, const LearnerSettings& settings) {
    // One after another: what a norm meets depends on those before it.
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
        if (graph.nodes[i].operation != Operation::batch_norm) continue;
        const auto observed = Learner(graph, settings).averaged_on(samples);
        adopt_statistics(graph.nodes[i], observed.nodes[i]);
    }
    return graph;
}

}  // namespace nn::training
