#include "search/gumbel.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <utility>

#include "search/noise.h"
#include "search/relaxed.h"

namespace search {

namespace {

constexpr float least_prior = 1e-9f;
// Of a search without a number of simulations: that of the first round, and how often it doubles.
constexpr std::uint64_t first_round = 64;
constexpr int most_rounds = 40;

// The mean, or what the end is sure to be, as the player sees it who moved there.
float value_of(const Node& node) {
    const auto ending = node.ending.load(relaxed);
    if (ending == Ending::loss) return 1;
    return ending == Ending::win ? -1 : node.mean();
}

float logit(const Edge& edge) { return std::log(std::max(edge.prior(), least_prior)); }

// What is known of each root move, in the order of the edges.
struct RootValues {
    std::vector<float> completed;  // in [0, 1], as the mover sees it
    std::uint32_t most_visits = 0;
};

// What the root was worth before its moves were searched: the visits that went to none of them.
float own_value(const Node& root, std::int64_t children_sum, std::uint64_t children_visits) {
    const auto visits = root.visits.load(relaxed);
    if (visits <= children_visits) return -root.mean();
    const auto sum = static_cast<double>(-root.value_sum.load(relaxed) - children_sum);
    const auto mean = sum / value_unit / static_cast<double>(visits - children_visits);
    return static_cast<float>(std::clamp(mean, -1.0, 1.0));
}

// The value of unvisited moves, equation 33 of the paper: the root's own, and the visited moves'
// weighted by their priors.
RootValues root_values(const Tree& tree) {
    const auto edges = tree.edges(tree.root());
    RootValues known;
    std::vector<bool> visited;
    std::int64_t sum = 0;
    std::uint64_t visits = 0;
    float priors = 0, weighted = 0;
    for (const Edge& edge : edges) {
        const NodeId id = tree.child(tree.root(), edge);
        const auto n = id == no_node ? 0 : tree[id].visits.load(relaxed);
        visited.push_back(n > 0);
        known.completed.push_back(n > 0 ? value_of(tree[id]) : 0);
        if (n == 0) continue;
        sum += tree[id].value_sum.load(relaxed);
        visits += n;
        known.most_visits = std::max(known.most_visits, n);
        const float prior = std::max(edge.prior(), least_prior);
        priors += prior;
        weighted += prior * known.completed.back();
    }
    const float own = own_value(tree[tree.root()], sum, visits);
    const auto n = static_cast<float>(visits);
    const float mixed = visits == 0 ? own : (own + n * weighted / priors) / (1 + n);
    for (std::size_t i = 0; i < edges.size(); ++i)
        known.completed[i] = ((visited[i] ? known.completed[i] : mixed) + 1) / 2;
    return known;
}

float sigma(const GumbelParams& params, const RootValues& known, std::size_t edge) {
    return (params.visit_offset + static_cast<float>(known.most_visits)) * params.scale *
           known.completed[edge];
}

}  // namespace

std::vector<float> improved_policy(const Tree& tree, const MoveFilter& allowed,
                                   const GumbelParams& params) {
    const auto edges = tree.edges(tree.root());
    const auto known = root_values(tree);
    std::vector<float> policy(edges.size());
    float most = -INFINITY, sum = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        policy[i] = allowed(edges[i].move) ? logit(edges[i]) + sigma(params, known, i) : -INFINITY;
        most = std::max(most, policy[i]);
    }
    for (float& share : policy) sum += share = std::exp(share - most);
    for (float& share : policy) share /= sum;
    return policy;
}

GumbelRoot::GumbelRoot(const Tree& tree, const MoveFilter& allowed,
                       std::optional<std::uint64_t> simulations, const GumbelParams& params,
                       engine::Random& random)
    : tree_(tree), params_(params) {
    const auto edges = tree.edges(tree.root());
    for (std::size_t i = 0; i < edges.size(); ++i)
        if (allowed(edges[i].move))
            all_.push_back({i, edges[i].move, params.noise * gumbel(random)});
    assert(!all_.empty());
    const auto drawn_before = [&](const Candidate& a, const Candidate& b) {
        return a.noise + logit(edges[a.edge]) > b.noise + logit(edges[b.edge]);
    };
    std::stable_sort(all_.begin(), all_.end(), drawn_before);
    const auto affordable = simulations.value_or(all_.size());
    const auto most = std::min<std::uint64_t>(affordable, static_cast<unsigned>(params.considered));
    all_.resize(std::clamp<std::size_t>(most, 1, all_.size()));
    if (simulations) {
        plan_round(0, *simulations);
    } else {
        for (int round = 0; round < most_rounds; ++round)
            plan_round(end_of_plan(), first_round << round);
    }
    phases_.front().candidates = all_;
}

std::uint64_t GumbelRoot::end_of_plan() const { return phases_.empty() ? 0 : phases_.back().first; }

// Each phase gives its candidates the same number of visits; half of them remain for the next. The
// last phase, of one visit each, is where the plan ends and what goes beyond it is spent.
void GumbelRoot::plan_round(std::uint64_t first, std::uint64_t simulations) {
    const auto halvings = static_cast<std::uint64_t>(std::bit_width(all_.size() - 1));
    if (!phases_.empty()) phases_.pop_back();
    auto left = static_cast<std::int64_t>(simulations);
    for (std::size_t count = all_.size(); left > 0; count = std::max<std::size_t>(count / 2, 2)) {
        count = std::min(count, all_.size());
        const auto each = std::max<std::uint64_t>(
            simulations / (std::max<std::uint64_t>(halvings, 1) * count), 1);
        phases_.push_back({first, std::vector<Candidate>(count), count});
        first += each * count;
        left -= static_cast<std::int64_t>(each * count);
    }
    const auto last = std::min<std::size_t>(all_.size(), 2);
    phases_.push_back({first, std::vector<Candidate>(last), last});
}

std::vector<GumbelRoot::Candidate> GumbelRoot::ranked(std::vector<Candidate> candidates) const {
    const auto edges = tree_.edges(tree_.root());
    const auto known = root_values(tree_);
    const auto score = [&](const Candidate& candidate) {
        return candidate.noise + logit(edges[candidate.edge]) +
               sigma(params_, known, candidate.edge);
    };
    std::vector<std::pair<float, Candidate>> scored;
    scored.reserve(candidates.size());
    for (const auto& candidate : candidates) scored.emplace_back(score(candidate), candidate);
    std::stable_sort(scored.begin(), scored.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    for (std::size_t i = 0; i < scored.size(); ++i) candidates[i] = scored[i].second;
    return candidates;
}

// By the one thread that moved `beginning_` there. A round begins with all candidates again.
void GumbelRoot::begin(std::size_t phase) {
    const auto& before = phases_[phase - 1];
    const bool anew = phases_[phase].count > before.count;
    const auto best = ranked(anew ? all_ : before.candidates);
    auto& candidates = phases_[phase].candidates;
    std::copy_n(best.begin(), candidates.size(), candidates.begin());
    begun_.store(phase, std::memory_order_release);
}

engine::Move GumbelRoot::next() {
    const auto turn = taken_.fetch_add(1, relaxed);
    auto begun = begun_.load(std::memory_order_acquire);
    while (begun + 1 < phases_.size() && turn >= phases_[begun + 1].first) {
        auto expected = begun;
        // Whoever comes while another works a phase out goes on with the one before.
        if (!beginning_.compare_exchange_strong(expected, begun + 1)) break;
        begin(++begun);
    }
    const auto& phase = phases_[begun];
    return phase.candidates[(turn - phase.first) % phase.count].move;
}

engine::Move GumbelRoot::best() const {
    const auto& phase = phases_[begun_.load(std::memory_order_acquire)];
    const auto searched = [&](const Candidate& candidate) {
        const NodeId id = tree_.child(tree_.root(), tree_.edges(tree_.root())[candidate.edge]);
        return id != no_node && tree_[id].visits.load(relaxed) > 0;
    };
    const auto best = ranked(phase.candidates);
    const auto found = std::find_if(best.begin(), best.end(), searched);
    return found == best.end() ? best.front().move : found->move;
}

}  // namespace search
