// AlphaGo's linear policies as a network: one dense layer from the features of a move
// (engine/go/move_features.h) to two logits, the rollout policy's and the tree policy's. So they
// are kept in files like any other.
#pragma once

#include <memory>
#include <vector>

#include "engine/go/linear_policy.h"
#include "nn/graph.h"

namespace search {

// A logit a feature.
struct LinearLogits {
    std::vector<float> rollout, tree;
};

nn::Graph graph_of(const LinearLogits& logits);
// Fails with engine::Error on any other network.
LinearLogits logits_of(const nn::Graph& graph);

// Fails as logits_of.
std::shared_ptr<const go::LinearPolicies> linear_policies_of(const nn::Graph& graph);

}  // namespace search
