#include "search/analysis.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "search/relaxed.h"

namespace search {

namespace {

std::uint32_t visits_of(const Tree& tree, NodeId id) {
    return id == no_node ? 0 : tree[id].visits.load(relaxed);
}

struct Candidate {
    const Edge* edge;
    NodeId node;
    std::uint32_t visits;
    float value;
    Ending ending;  // as the root's mover sees it
    int plies;
};

// As the player sees it who moved there.
Ending seen_before(Ending ending) {
    if (ending == Ending::win) return Ending::loss;
    return ending == Ending::loss ? Ending::win : ending;
}

Candidate candidate(const Tree& tree, const Edge& edge) {
    const NodeId id = tree.child(tree.root(), edge);
    if (id == no_node) return {&edge, id, 0, 0, Ending::unknown, 0};
    const Node& node = tree[id];
    const auto ending = seen_before(node.ending.load(relaxed));
    const float value = ending == Ending::win    ? 1.0f
                        : ending == Ending::loss ? -1.0f
                                                 : tree.value(node);
    return {&edge, id, visits_of(tree, id), value, ending, node.plies + 1};
}

std::vector<Candidate> candidates(const Tree& tree, const MoveFilter& filter) {
    std::vector<Candidate> found;
    if (!tree[tree.root()].expanded()) return found;
    for (const Edge& edge : tree.edges(tree.root()))
        if (filter(edge.move)) found.push_back(candidate(tree, edge));
    return found;
}

// Sure wins first and sure losses last.
int rank(Ending ending) { return ending == Ending::win ? 0 : ending == Ending::loss ? 2 : 1; }

// Which fate a player would rather have, as the player sees it: the quick win, the late loss. Empty
// where they are as good as each other.
std::optional<bool> happier(Ending a, int plies_a, Ending b, int plies_b) {
    if (rank(a) != rank(b)) return rank(a) < rank(b);
    if (plies_a == plies_b || rank(a) == 1) return std::nullopt;
    return a == Ending::win ? plies_a < plies_b : plies_a > plies_b;
}

bool better(const Candidate& a, const Candidate& b) {
    if (const auto fate = happier(a.ending, a.plies, b.ending, b.plies)) return *fate;
    if (a.visits != b.visits) return a.visits > b.visits;
    if (a.visits > 0 && a.value != b.value) return a.value > b.value;
    return a.edge->packed_prior > b.edge->packed_prior;
}

// Five standard errors below the mean. A few visits may agree by chance: to their variance come
// those of two visits of the greatest variance there can be.
float lower_bound(const Tree& tree, const Candidate& candidate) {
    constexpr float errors = 5, doubtful = 2;
    if (Node::decides(candidate.ending)) return candidate.value;
    if (candidate.visits == 0) return -1;
    const auto n = static_cast<float>(candidate.visits);
    const float variance = (n * tree[candidate.node].variance() + doubtful) / (n + doubtful);
    return std::max(-1.0f, candidate.value - errors * std::sqrt(variance / n));
}

// The one to play: of those with a good part of the most visits that of the highest bound.
std::size_t best_by_bound(const Tree& tree, const std::vector<Candidate>& found) {
    constexpr float good_part = 0.15f;
    std::size_t best = 0;
    if (found.empty() || rank(found[0].ending) != 1) return best;
    float most = lower_bound(tree, found[0]);
    for (std::size_t i = 1; i < found.size(); ++i) {
        const bool enough =
            static_cast<float>(found[i].visits) >= good_part * static_cast<float>(found[0].visits);
        if (!enough || rank(found[i].ending) != 1) continue;
        const float bound = lower_bound(tree, found[i]);
        if (bound > most) best = i, most = bound;
    }
    return best;
}

// Whether a player would rather move to `a` than to `b`.
bool likelier(const Node& a, const Node& b) {
    const auto ending = [](const Node& node) { return seen_before(node.ending.load(relaxed)); };
    if (const auto fate = happier(ending(a), a.plies, ending(b), b.plies)) return *fate;
    return a.visits.load(relaxed) > b.visits.load(relaxed);
}

void follow(const Tree& tree, NodeId node, int length, MoveAnalysis& to) {
    while (static_cast<int>(to.variation.size()) < length && tree[node].expanded()) {
        const Edge* best = nullptr;
        NodeId next = no_node;
        for (const Edge& edge : tree.edges(node)) {
            const NodeId child = tree.child(node, edge);
            if (visits_of(tree, child) > 0 && (!best || likelier(tree[child], tree[next])))
                best = &edge, next = child;
        }
        if (!best) return;
        to.variation.push_back(best->move);
        to.variation_visits.push_back(visits_of(tree, next));
        node = next;
    }
}

std::optional<int> sure_plies(const Candidate& candidate) {
    if (!Node::decides(candidate.ending)) return std::nullopt;
    if (candidate.ending == Ending::draw) return 0;
    return candidate.ending == Ending::win ? candidate.plies : -candidate.plies;
}

MoveAnalysis describe(const Tree& tree, const Candidate& candidate, const Telling& telling) {
    MoveAnalysis move;
    move.move = candidate.edge->move;
    move.visits = candidate.visits;
    move.prior = candidate.edge->prior();
    move.value = candidate.ending == Ending::draw ? telling.draw_score : candidate.value;
    move.lcb = lower_bound(tree, candidate);
    move.sure = sure_plies(candidate);
    move.variation = {move.move};
    move.variation_visits = {move.visits};
    if (candidate.node == no_node) return move;
    move.draws = candidate.ending == Ending::draw ? 1 : tree[candidate.node].draws.value();
    follow(tree, candidate.node, telling.variation_length, move);
    return move;
}

}  // namespace

std::vector<MoveAnalysis> describe_moves(const Tree& tree, const MoveFilter& filter,
                                         const Telling& telling) {
    auto found = candidates(tree, filter);
    std::stable_sort(found.begin(), found.end(), better);
    std::size_t first = telling.by_bound ? best_by_bound(tree, found) : 0;
    for (std::size_t i = 0; telling.first && i < found.size(); ++i)
        if (found[i].edge->move == *telling.first) first = i;
    const auto begin = found.begin();
    const auto chosen = begin + static_cast<std::ptrdiff_t>(first);
    if (first > 0) std::rotate(begin, chosen, chosen + 1);
    found.resize(std::min(found.size(), static_cast<std::size_t>(std::max(telling.most_moves, 0))));
    std::vector<MoveAnalysis> moves;
    moves.reserve(found.size());
    for (const auto& candidate : found) moves.push_back(describe(tree, candidate, telling));
    return moves;
}

Standing standing(const Tree& tree, const MoveFilter& filter) {
    const auto found = candidates(tree, filter);
    Standing now;
    now.moves = static_cast<int>(found.size());
    if (found.empty()) return now;
    const auto& first = *std::min_element(found.begin(), found.end(), better);
    now.first = first.edge->move;
    now.first_visits = first.visits;
    now.value = first.value;
    int open = 0, losses = 0;
    for (const auto& candidate : found) {
        open += Node::decides(candidate.ending) ? 0 : 1;
        losses += candidate.ending == Ending::loss ? 1 : 0;
        if (&candidate == &first) continue;
        now.second_visits = std::max<std::uint64_t>(now.second_visits, candidate.visits);
        // A value from a handful of visits says nothing.
        const bool weighty = candidate.visits * 10 >= first.visits;
        now.first_is_best = now.first_is_best && !(weighty && candidate.value > first.value);
    }
    now.decided = first.ending == Ending::win || open == 0 || losses + 1 >= now.moves;
    return now;
}

}  // namespace search
