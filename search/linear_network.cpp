#include "search/linear_network.h"

#include <algorithm>

#include "engine/base/error.h"
#include "nn/builders.h"

namespace search {

namespace {

constexpr std::string_view encoding = "move-features";

template <class Graph>
auto* weights_of(Graph& graph) {
    const auto found =
        std::find_if(graph.nodes.begin(), graph.nodes.end(),
                     [](const nn::Node& node) { return node.operation == nn::Operation::dense; });
    return found == graph.nodes.end() ? nullptr : &found->weights[0];
}

}  // namespace

nn::Graph graph_of(const LinearLogits& logits) {
    nn::Facts facts;
    facts.game = "go";
    facts.encoding = encoding;
    facts.name = "linear policies";
    facts.source = "sanban learn rollout";
    engine::Random random(0);
    auto graph = nn::build_mlp(facts, {go::features::count, 2}, random);
    auto& weights = weights_of(graph)->values;
    const auto next = std::copy(logits.rollout.begin(), logits.rollout.end(), weights.begin());
    std::copy(logits.tree.begin(), logits.tree.end(), next);
    return graph;
}

LinearLogits logits_of(const nn::Graph& graph) {
    const auto* const weights = weights_of(graph);
    const std::vector<int> expected{2, go::features::count};
    if (graph.facts.encoding != encoding || !weights || weights->shape != expected)
        engine::fail(
            "expected linear policies of Go with {} features, as sanban learn rollout "
            "makes them, found another network",
            go::features::count);
    const auto middle = weights->values.begin() + go::features::count;
    return {{weights->values.begin(), middle}, {middle, weights->values.end()}};
}

std::shared_ptr<const go::LinearPolicies> linear_policies_of(const nn::Graph& graph) {
    const auto logits = logits_of(graph);
    return std::make_shared<const go::LinearPolicies>(
        go::LinearPolicies{go::Factors(logits.rollout), go::Factors(logits.tree)});
}

}  // namespace search
