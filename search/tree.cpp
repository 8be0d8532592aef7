#include "search/tree.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <functional>
#include <new>

#include "search/relaxed.h"

namespace search {

namespace {

constexpr std::size_t node_units = sizeof(Node) / 8;
constexpr std::size_t edge_units(std::size_t edges) { return (edges * sizeof(Edge) + 7) / 8; }
// Kept back in each half, so that a new root can always be copied.
constexpr std::size_t root_reserve = 4 * (node_units + edge_units(640));
constexpr std::size_t least_budget = std::size_t{1} << 20, most_budget = std::size_t{32} << 30;

void copy_counts(const Node& from, Node& to) {
    to.value_sum.store(from.value_sum.load(relaxed), relaxed);
    to.network_sum.store(from.network_sum.load(relaxed), relaxed);
    to.visits.store(from.visits.load(relaxed), relaxed);
    to.network_visits.store(from.network_visits.load(relaxed), relaxed);
    to.stage.store(from.stage.load(relaxed), relaxed);
    to.ending.store(from.ending.load(relaxed), relaxed);
    to.plies.store(from.plies.load(relaxed), relaxed);
    to.squares.copy(from.squares);
    to.draws.copy(from.draws);
}

}  // namespace

float Node::variance() const {
    if (visits.load(relaxed) < 2) return 0;
    const float middle = mean();
    return std::max(squares.value() - middle * middle, 0.0f);
}

void SmallMean::add(float sample, std::uint32_t count) {
    constexpr std::uint32_t golden = 2654435769u;  // 2^32 times the golden ratio's fraction
    const auto dither = static_cast<float>(count * golden >> 8) / (1 << 24);
    const auto mean = static_cast<float>(packed_.load(relaxed));
    const float step = (std::clamp(sample, 0.0f, 1.0f) * most - mean) / static_cast<float>(count);
    packed_.store(static_cast<std::uint16_t>(std::clamp(mean + step + dither, 0.0f, most)),
                  relaxed);
}

void AmafCount::add(float value) {
    const auto packed = packed_.load(relaxed);
    auto visits = (packed >> 16) + 1;
    auto wins = (packed & 0xffff) + static_cast<std::uint32_t>(value + 1.5f);
    if (visits >= most_visits) visits /= 2, wins /= 2;
    packed_.store(visits << 16 | wins, relaxed);
}

float AmafCount::mean() const {
    const auto packed = packed_.load(relaxed);
    if (packed == 0) return 0;
    return static_cast<float>(packed & 0xffff) / static_cast<float>(packed >> 16) - 1;
}

Tree::Tree(std::size_t budget_bytes)
    : memory_(std::clamp(budget_bytes, least_budget, most_budget), least_budget),
      base_(memory_.data()),
      half_units_(memory_.size() / unit / 2) {
    clear();
}

NodeId Tree::child(NodeId parent, const Edge& edge) const {
    const NodeId id = edge.child.load(std::memory_order_acquire);
    // A passive node's reference to the active half is to what was there before the flip.
    return id != no_node && active(id) && !active(parent) ? no_node : id;
}

double Tree::share_used() const {
    const auto left = end_ - std::min(end_, next_.load(relaxed));
    return static_cast<double>(half_units_ - left + passive_used_) /
           static_cast<double>(2 * half_units_);
}

NodeId Tree::enter(Edge& edge) {
    NodeId id = edge.child.load(std::memory_order_acquire);
    if (id == no_node || !active(id)) {
        NodeId made = no_node;
        if (id != no_node) {
            made = copy(id, root_reserve);
        } else if ((made = allocate(node_units, root_reserve)) != no_node) {
            new (&node(made)) Node;
        }
        if (made == no_node) return no_node;
        if (edge.child.compare_exchange_strong(id, made, std::memory_order_acq_rel)) id = made;
    }
    node(id).in_flight.fetch_add(1, relaxed);
    return id;
}

void Tree::mark(NodeId id, Ending ending, int plies) {
    auto unknown = Ending::unknown;
    if (plies > 0) node(id).plies.store(static_cast<std::uint16_t>(plies), relaxed);
    node(id).ending.compare_exchange_strong(unknown, ending, relaxed);
}

void Tree::unmark(NodeId id) {
    node(id).ending.store(Ending::none, relaxed);
    node(id).plies.store(0, relaxed);
}

void Tree::prove(const Path& path, bool lists_all) {
    for (auto i = path.size() - 1; i-- > 1;)
        if (!settle(path[i], node(path[i + 1]), lists_all)) return;
}

// Whether `parent` is decided now and was not before, one of its children being `child`.
bool Tree::settle(NodeId parent, const Node& child, bool lists_all) {
    Node& settled = node(parent);
    if (settled.decided()) return false;
    const auto decide = [&](Ending ending, int plies) {
        settled.plies.store(static_cast<std::uint16_t>(std::min(plies + 1, 0xffff)), relaxed);
        settled.ending.store(ending, relaxed);
        return true;
    };
    if (child.ending.load(relaxed) == Ending::loss) return decide(Ending::win, child.plies);
    if (!lists_all) return false;
    bool draw = false;
    int longest = 0;
    for (const Edge& edge : edge_span(settled)) {
        const NodeId id = this->child(parent, edge);
        if (id == no_node || !node(id).decided()) return false;
        draw = draw || node(id).ending.load(relaxed) == Ending::draw;
        longest = std::max<int>(longest, node(id).plies);
    }
    return decide(draw ? Ending::draw : Ending::loss, longest);
}

bool Tree::claim(NodeId id) {
    auto fresh = Stage::fresh;
    return node(id).stage.compare_exchange_strong(fresh, Stage::claimed);
}

bool Tree::expand(NodeId id, const engine::MoveList& moves, std::span<const float> priors) {
    const auto count = static_cast<std::size_t>(moves.size());
    assert(priors.empty() || priors.size() == count);
    const NodeId first = allocate(edge_units(count), root_reserve);
    if (first == no_node) return unclaim(id), false;
    Node& parent = node(id);
    parent.first_edge = first;
    parent.edge_count = count & 0x7fff;
    parent.in_order = std::is_sorted(priors.begin(), priors.end(), std::greater<>());
    const auto equal = pack_prior(1 / static_cast<float>(std::max<std::size_t>(count, 1)));
    const auto edges = edge_span(parent);
    for (std::size_t i = 0; i < count; ++i) {
        Edge& edge = *new (&edges[i]) Edge;
        edge.move = moves[static_cast<int>(i)];
        edge.packed_prior.store(priors.empty() ? equal : pack_prior(priors[i]), relaxed);
    }
    parent.stage.store(Stage::expanded, std::memory_order_release);
    return true;
}

void Tree::back_up(const Path& path, float value, float draws) {
    auto amount = fixed_point(value);
    const float square = value * value;
    for (auto id = path.rbegin(); id != path.rend(); ++id) {
        amount = -amount;
        Node& passed = node(*id);
        passed.value_sum.fetch_add(amount, relaxed);
        const auto visits = passed.visits.fetch_add(1, relaxed) + 1;
        passed.squares.add(square, visits);
        passed.draws.add(draws, visits);
        passed.in_flight.fetch_sub(1, relaxed);
    }
}

void Tree::add_amaf(NodeId id, std::span<const std::int8_t> firsts, int mover, float value) {
    for (Edge& edge : edge_span(node(id)))
        if (edge.move.code < firsts.size() && firsts[edge.move.code] == mover) edge.amaf.add(value);
}

void Tree::withdraw(const Path& path) {
    for (const NodeId id : path) node(id).in_flight.fetch_sub(1, relaxed);
}

void Tree::flip() {
    const NodeId old_root = root_;
    assert(node(old_root).in_flight == 0);
    passive_used_ = half_units_;
    activate(1 - active_half_);
    root_ = copy(old_root, 0);
    assert(root_ != no_node);
}

void Tree::clear() {
    passive_used_ = 0;
    activate(0);
    root_ = allocate(node_units, 0);
    new (&node(root_)) Node;
}

void Tree::replace_root_priors(std::span<const float> priors) {
    set_priors(root_, priors);
    node(root_).in_order = 0;
}

void Tree::set_priors(NodeId id, std::span<const float> priors) {
    const auto edges = edge_span(node(id));
    assert(priors.size() == edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i)
        edges[i].packed_prior.store(pack_prior(priors[i]), relaxed);
}

void Tree::add_network_value(const Path& path, float value) {
    auto amount = fixed_point(value);
    for (auto id = path.rbegin(); id != path.rend(); ++id) {
        amount = -amount;
        node(*id).network_sum.fetch_add(amount, relaxed);
        node(*id).network_visits.fetch_add(1, relaxed);
    }
}

bool Tree::advance(engine::Move move) {
    for (Edge& edge : edge_span(node(root_))) {
        if (edge.move != move || edge.child == no_node) continue;
        const NodeId id = edge.child;
        const NodeId next = active(id) ? id : copy(id, 0);
        if (next == no_node) return false;
        root_ = next;
        return true;
    }
    return false;
}

NodeId Tree::allocate(std::size_t units, std::size_t reserve) {
    // Checked first, so that the counter, once past the end, does not run away.
    if (next_.load(relaxed) + units + reserve > end_) return no_node;
    const auto first = next_.fetch_add(units, relaxed);
    return first + units + reserve > end_ ? no_node : static_cast<NodeId>(first);
}

NodeId Tree::copy(NodeId passive, std::size_t reserve) {
    const Node& from = node(passive);
    const auto old_edges = edge_span(from);
    const NodeId id = allocate(node_units + edge_units(old_edges.size()), reserve);
    if (id == no_node) return no_node;
    Node& to = *new (&node(id)) Node;
    copy_counts(from, to);
    to.edge_count = from.edge_count;
    to.in_order = from.in_order;
    to.first_edge = static_cast<NodeId>(id + node_units);
    const auto new_edges = edge_span(to);
    for (std::size_t i = 0; i < old_edges.size(); ++i) {
        Edge& edge = *new (&new_edges[i]) Edge;
        edge.move = old_edges[i].move;
        edge.packed_prior.store(old_edges[i].packed_prior, relaxed);
        edge.amaf.copy(old_edges[i].amaf);
        const NodeId kept = child(passive, old_edges[i]);
        edge.child.store(kept, relaxed);
        if (kept != old_edges[i].child) to.in_order = 0;
    }
    return id;
}

void Tree::activate(int half) {
    active_half_ = half;
    const auto first = static_cast<std::size_t>(half) * half_units_;
    next_ = std::max<std::size_t>(first, 1);  // unit 0 is no_node
    end_ = first + half_units_;
}

}  // namespace search
