// Which edge a descent takes: one small type a rule. A rule is prepared once a node with its
// visit count and then scores each edge by what is known of its child. A move that is known to win
// is always taken, one that is known to lose only when all do.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "search/relaxed.h"
#include "search/tree.h"

namespace search {

// The natural logarithm to 6 digits for x >= 1, from operations that IEEE 754 defines to the last
// bit: the libraries' differ from processor to processor, and with them the signature.
inline float portable_log(float x) {
    const auto bits = std::bit_cast<std::uint32_t>(x);
    const float fraction = std::bit_cast<float>((bits & 0x007fffffu) | 0x3f800000u);  // 1..2
    const auto exponent = static_cast<float>(static_cast<int>(bits >> 23) - 127);
    // ln m = 2 artanh t, about the middle of 1..2.
    const float t = (fraction - 1.41421356f) / (fraction + 1.41421356f), square = t * t;
    const float series = 1 + square * (1 / 3.0f + square * (1 / 5.0f + square * (1 / 7.0f)));
    return (exponent + 0.5f) * 0.69314718f + 2 * t * series;
}

// UCB1 (Auer et al. 2002) as UCT uses it (Kocsis & Szepesvari 2006): mean value as the mover sees
// it plus exploration * sqrt(ln N / n). An unvisited move scores `unvisited`; above any value plus
// bound, that means each is tried once before any is tried twice.
struct Ucb1 {
    float exploration = 0.5f;
    float unvisited = 10;

    class AtNode {
       public:
        AtNode(const Ucb1& rule, const Node& parent)
            : rule_(rule),
              log_visits_(portable_log(static_cast<float>(parent.visits.load(relaxed) +
                                                          parent.in_flight.load(relaxed) + 1u))) {}

        float score(const Edge&, const Node* child) const {
            if (!child) return rule_.unvisited;
            const std::uint32_t losses = child->in_flight.load(relaxed);
            const auto tries = child->visits.load(relaxed) + losses;
            if (tries == 0) return rule_.unvisited;
            return child->mean(losses) +
                   rule_.exploration * std::sqrt(log_visits_ / static_cast<float>(tries));
        }

       private:
        const Ucb1& rule_;
        float log_visits_;
    };
};

// UCT-RAVE (Gelly & Silver 2007): UCB1 whose mean is mixed with that of all rollouts in which the
// move was made at any later time. With n own and m such visits these weigh
// m / (n + m + n m / equivalence): all at first, half when n is about `equivalence`. A prior of
// P counts as `prior_visits` of these m, each of the value (r - 1) / (r + 1): r is P over the mean
// prior, so that this is how often the move would beat an average one (Bradley & Terry 1952).
struct Rave {
    Ucb1 ucb1;
    float equivalence = 1000;
    float prior_visits = 0;

    // For a search whose root has so many visits: few of them cannot make up for a wrong prior, so
    // priors count a third at first, and in full from some thousands on.
    Rave sized(std::uint32_t root_visits) const {
        Rave rule = *this;
        const auto n = static_cast<float>(root_visits);
        rule.prior_visits *= (n + 100) / (n + 300);
        return rule;
    }

    class AtNode {
       public:
        AtNode(const Rave& rule, const Node& parent)
            : rule_(rule),
              log_visits_(portable_log(static_cast<float>(parent.visits.load(relaxed) +
                                                          parent.in_flight.load(relaxed) + 1u))),
              edges_(parent.edge_count) {}

        float score(const Edge& edge, const Node* child) const {
            const auto made = static_cast<float>(edge.amaf.visits());
            const float m = made + rule_.prior_visits;
            const std::uint32_t losses = child ? child->in_flight.load(relaxed) : 0;
            const auto visits = child ? child->visits.load(relaxed) : 0;
            const auto n = static_cast<float>(visits + losses);
            if (n + m == 0) return rule_.ucb1.unvisited;
            const float share = m / (n + m + n * m / rule_.equivalence);
            const float own = child ? child->mean(losses) : 0;
            const float ratio = edge.prior() * edges_;
            const float wins =
                made * edge.amaf.mean() + rule_.prior_visits * (ratio - 1) / (ratio + 1);
            return own + share * (wins / std::max(m, 1.0f) - own) +
                   rule_.ucb1.exploration * std::sqrt(log_visits_ / (n + 1));
        }

       private:
        const Rave& rule_;
        float log_visits_, edges_;
    };
};

// PUCT (Rosin 2011) as AlphaGo Zero and AlphaZero use it (Silver et al. 2017, 2018): mean value as
// the mover sees it plus c P sqrt(N) / (1 + n), where c = exploration + growth ln((1 + N + base) /
// base). An unvisited move is taken to be worth the node less `reduction` times the root of the
// priors that have been visited (first-play urgency).
struct Puct {
    float exploration = 1.25f, growth = 1, base = 19652;
    float reduction = 0.25f, root_reduction = 0.25f;
    float virtual_loss = 1;
};

// AlphaGo's PUCT with two counts (Silver et al. 2016): rollouts and networks are averaged apart and
// blended by lambda, and exploration goes by rollouts alone. A visit under way counts as
// `virtual_loss` rollouts lost; an unvisited move is worth a draw.
struct TwoCounts {
    float exploration = 5, lambda = 0.5f, virtual_loss = 3;

    class AtNode {
       public:
        AtNode(const TwoCounts& rule, const Node& parent)
            : rule_(rule),
              scale_(rule.exploration * std::sqrt(std::max(rule.count(parent), 1.0f))) {}

        float score(const Edge& edge, const Node* child) const {
            const float prior = scale_ * edge.prior();
            if (!child) return prior;
            const float losses = rule_.losses(*child);
            return child->blended(rule_.lambda, static_cast<double>(losses)) +
                   prior / (1 + rule_.count(*child));
        }

       private:
        const TwoCounts& rule_;
        float scale_;
    };

    float losses(const Node& node) const {
        return virtual_loss * static_cast<float>(node.in_flight.load(relaxed));
    }
    float count(const Node& node) const {
        return static_cast<float>(node.visits.load(relaxed)) + losses(node);
    }
};

template <class Allowed>
Edge* select(Tree& tree, NodeId id, const Puct& rule, Allowed allowed) {
    const Node& parent = tree[id];
    const auto n = static_cast<float>(parent.visits.load(relaxed) + parent.in_flight.load(relaxed));
    const float c = rule.exploration + rule.growth * portable_log((1 + n + rule.base) / rule.base);
    const float scale = c * std::sqrt(std::max(n, 1.0f));
    // Then all behind the first unvisited move are unvisited, and none has a higher prior.
    const bool prefix = id != tree.root() && tree.in_order(id);
    for (const Edge& edge : tree.edges(id)) {
        const NodeId child = edge.child.load(relaxed);
        if (child != no_node) tree.prefetch(child);
        if (child == no_node && prefix) break;
    }
    Edge *best = nullptr, *unvisited = nullptr, *lost = nullptr;
    float best_score = 0, visited_priors = 0;
    for (Edge& edge : tree.edges_to_enter(id)) {
        if (!allowed(edge.move)) continue;
        const NodeId child = edge.child.load(std::memory_order_acquire);
        if (child == no_node) {
            if (!unvisited || edge.packed_prior > unvisited->packed_prior) unvisited = &edge;
            if (prefix) break;
            continue;
        }
        const Node& node = tree[child];
        const float prior = edge.prior();
        const std::uint32_t losses = node.in_flight.load(relaxed);
        const auto visits = node.visits.load(relaxed);
        if (visits + losses == 0) {
            if (!unvisited || edge.packed_prior > unvisited->packed_prior) unvisited = &edge;
            continue;
        }
        visited_priors += prior;
        const auto ending = node.ending.load(relaxed);
        if (ending == Ending::loss) return &edge;
        if (ending == Ending::win) {
            lost = &edge;
            continue;
        }
        const float score = node.mean(static_cast<float>(losses) * rule.virtual_loss) +
                            scale * prior / static_cast<float>(1 + visits + losses);
        if (!best || score > best_score) best = &edge, best_score = score;
    }
    if (!unvisited) return best ? best : lost;
    const float reduction = id == tree.root() ? rule.root_reduction : rule.reduction;
    const float urgency =
        -parent.mean() - reduction * std::sqrt(visited_priors) + scale * unvisited->prior();
    return best && best_score >= urgency ? best : unvisited;
}

// The best-scored edge of an expanded node among those that `allowed` is true of, the first of
// equals; nullptr when there is none.
template <class Rule, class Allowed>
Edge* select(Tree& tree, NodeId id, const Rule& rule, Allowed allowed) {
    const typename Rule::AtNode at_node(rule, tree[id]);
    Edge *best = nullptr, *lost = nullptr;
    float best_score = 0;
    for (Edge& edge : tree.edges_to_enter(id)) {
        if (!allowed(edge.move)) continue;
        const NodeId child = edge.child.load(std::memory_order_acquire);
        const auto ending = child == no_node ? Ending::unknown : tree[child].ending.load(relaxed);
        if (ending == Ending::loss) return &edge;
        if (ending == Ending::win) {
            lost = &edge;
            continue;
        }
        const float score = at_node.score(edge, child == no_node ? nullptr : &tree[child]);
        if (!best || score > best_score) best = &edge, best_score = score;
    }
    return best ? best : lost;
}

}  // namespace search
