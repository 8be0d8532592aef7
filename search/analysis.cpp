#include "search/analysis.h"

#include <algorithm>
#include <cmath>

namespace search {

namespace {

std::uint32_t visits_of(const Tree& tree, NodeId id) {
    return id == no_node ? 0 : tree[id].visits.load(std::memory_order_relaxed);
}

struct Candidate {
    const Edge* edge;
    NodeId node;
    std::uint32_t visits;
    float value;
};

std::vector<Candidate> candidates(const Tree& tree, const MoveFilter& filter) {
    std::vector<Candidate> found;
    if (!tree[tree.root()].expanded()) return found;
    for (const Edge& edge : tree.edges(tree.root())) {
        if (!filter(edge.move)) continue;
        const NodeId node = tree.child(tree.root(), edge);
        found.push_back(
            {&edge, node, visits_of(tree, node), node == no_node ? 0 : tree[node].mean()});
    }
    return found;
}

bool better(const Candidate& a, const Candidate& b) {
    if (a.visits != b.visits) return a.visits > b.visits;
    if (a.visits > 0 && a.value != b.value) return a.value > b.value;
    return a.edge->packed_prior > b.edge->packed_prior;
}

// Values lie in [-1, 1], so their variance is at most 1 - mean², which rollouts that end in a win
// or a loss attain. Two standard errors, by Agresti and Coull's estimate, which does not collapse
// at a mean of 1.
float lower_bound(float mean, std::uint32_t visits) {
    const auto n = static_cast<float>(visits);
    const float shrunk = mean * n / (n + 4);
    return std::max(-1.0f, mean - 2 * std::sqrt((1 - shrunk * shrunk) / (n + 4)));
}

void follow(const Tree& tree, NodeId node, int length, MoveAnalysis& to) {
    while (static_cast<int>(to.variation.size()) < length && tree[node].expanded()) {
        const Edge* best = nullptr;
        NodeId next = no_node;
        for (const Edge& edge : tree.edges(node)) {
            const NodeId child = tree.child(node, edge);
            if (visits_of(tree, child) > visits_of(tree, next)) best = &edge, next = child;
        }
        if (!best) return;
        to.variation.push_back(best->move);
        to.variation_visits.push_back(visits_of(tree, next));
        node = next;
    }
}

MoveAnalysis describe(const Tree& tree, const Candidate& candidate, int variation_length) {
    MoveAnalysis move;
    move.move = candidate.edge->move;
    move.visits = candidate.visits;
    move.prior = candidate.edge->prior();
    move.value = candidate.value;
    move.lcb = lower_bound(candidate.value, candidate.visits);
    move.variation = {move.move};
    move.variation_visits = {move.visits};
    if (candidate.node != no_node) follow(tree, candidate.node, variation_length, move);
    return move;
}

}  // namespace

std::vector<MoveAnalysis> describe_moves(const Tree& tree, const MoveFilter& filter, int most_moves,
                                         int variation_length) {
    auto found = candidates(tree, filter);
    std::stable_sort(found.begin(), found.end(), better);
    found.resize(std::min(found.size(), static_cast<std::size_t>(std::max(most_moves, 0))));
    std::vector<MoveAnalysis> moves;
    moves.reserve(found.size());
    for (const auto& candidate : found)
        moves.push_back(describe(tree, candidate, variation_length));
    return moves;
}

Standing standing(const Tree& tree, const MoveFilter& filter) {
    const auto found = candidates(tree, filter);
    Standing now;
    now.moves = static_cast<int>(found.size());
    const Candidate* first = nullptr;
    for (const auto& candidate : found)
        if (!first || better(candidate, *first)) first = &candidate;
    if (!first) return now;
    now.first_visits = first->visits;
    now.value = first->value;
    for (const auto& candidate : found) {
        if (&candidate == first) continue;
        now.second_visits = std::max<std::uint64_t>(now.second_visits, candidate.visits);
        // A value from a handful of visits says nothing.
        const bool weighty = candidate.visits * 10 >= first->visits;
        now.first_is_best = now.first_is_best && !(weighty && candidate.value > first->value);
    }
    return now;
}

}  // namespace search
