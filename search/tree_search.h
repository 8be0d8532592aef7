// Monte Carlo tree search in three verbs: gather leaves, evaluate them, absorb the verdicts.
// Playing, analysis and self-play are all loops over these three.
//
// gather(), absorb() and abandon() may be called by any number of workers at once, the rest by
// one thread while no descent is under way.
#pragma once

#include <algorithm>
#include <atomic>
#include <cassert>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

#include "engine/forced_mate.h"
#include "search/leaf.h"
#include "search/move_filter.h"
#include "search/noise.h"
#include "search/params.h"
#include "search/relaxed.h"
#include "search/selection.h"

namespace search {

enum class Gathered : std::uint8_t {
    leaf,      // to be evaluated, then absorbed
    absorbed,  // the descent ended at a finished game and is done
    taken,     // the leaf is in other hands: try again later
    full       // the tree is: flip it
};

// A side's own moves that the rest of the game is likely to take, as the clock must plan.
template <engine::Game G>
int moves_to_come(const G& game) {
    if constexpr (requires { game.moves_to_come(); })
        return game.moves_to_come();
    else
        return 30;
}

template <engine::Game G>
class TreeSearch {
   public:
    using Rule = std::variant<Ucb1, Rave, Puct, TwoCounts>;

    // `network`: whether leaves are judged by one.
    explicit TreeSearch(const SearchParams& params, bool network = false)
        : params_(params),
          network_(network),
          rule_(rule_of(params, network)),
          tree_(static_cast<std::size_t>(params.memory_mib) << 20) {
        tree_.set_blend(blend());
        set_visits_to_expand(params.expand_after);
    }

    const Tree& tree() const { return tree_; }
    const G& root() const { return root_; }
    const MoveFilter& filter() const { return filter_; }
    // The root moves to choose from. When they ask for one that the tree left out, it starts anew.
    void restrict_root(const MoveFilter& filter, std::span<const engine::Move> asked_for) {
        filter_ = filter;
        if (!tree_[tree_.root()].expanded()) return;
        const auto edges = tree_.edges(tree_.root());
        const auto missing = [&](engine::Move move) {
            return std::none_of(edges.begin(), edges.end(),
                                [&](const Edge& edge) { return edge.move == move; });
        };
        if (std::any_of(asked_for.begin(), asked_for.end(), missing)) tree_.clear();
    }

    // Keeps the tree where the memory budget stays what it was.
    void set_params(const SearchParams& params) {
        params_ = params;
        rule_ = rule_of(params, network_);
        tree_.set_blend(blend());
        set_visits_to_expand(params.expand_after);
    }
    // What params say of it holds until then. From any thread.
    void set_visits_to_expand(int visits) { visits_to_expand_.store(visits, relaxed); }

    // The moves of the tree, two at most, from the root to `game`; empty when there is no such
    // line.
    std::vector<engine::Move> line_to(const G& game) const {
        const auto visited = [&](NodeId parent, const Edge& edge) {
            const NodeId child = tree_.child(parent, edge);
            return child != no_node && tree_[child].visits > 0 ? child : no_node;
        };
        for (const Edge& first : tree_.edges(tree_.root())) {
            const NodeId node = visited(tree_.root(), first);
            if (node == no_node) continue;
            G after_one = root_;
            after_one.play(first.move);
            if (after_one == game) return {first.move};
            if (after_one.to_play() == game.to_play() || !tree_[node].expanded()) continue;
            for (const Edge& second : tree_.edges(node)) {
                if (visited(node, second) == no_node) continue;
                G after_two = after_one;
                after_two.play(second.move);
                if (after_two == game) return {first.move, second.move};
            }
        }
        return {};
    }

    void set_root(const G& root) {
        root_ = root;
        tree_.clear();
    }
    // Plays `move`, legal at the root, and keeps what the tree has below it.
    void advance(engine::Move move) {
        root_.play(move);
        if (!tree_.advance(move)) return tree_.clear();
        // Whatever it is sure to come to, there is a move to choose.
        const auto root = tree_.root();
        if (tree_[root].decided() && !root_.legal_moves().empty()) tree_.unmark(root);
    }
    // The side that params' worth of a draw is meant for. Forgets the tree where that matters.
    void favour(engine::Player player) {
        if (favoured_ == player) return;
        favoured_ = player;
        if (params_.draw_score != 0) tree_.clear();
    }
    void flip() { tree_.flip(); }

    // Mixes Dirichlet's noise into the priors of the expanded root: (1 - share) P + share
    // Dir(alpha) (AlphaGo Zero); with an alpha of 0 it is 10 / legal moves (AlphaZero's, about).
    // Each call mixes in more.
    void mix_root_noise(engine::Random& random, float share, float alpha) {
        const auto edges = tree_.edges(tree_.root());
        const float usual = 10 / static_cast<float>(edges.size());
        auto priors = dirichlet(random, edges.size(), alpha > 0 ? alpha : usual);
        for (std::size_t i = 0; i < edges.size(); ++i)
            priors[i] = (1 - share) * edges[i].prior() + share * priors[i];
        tree_.replace_root_priors(priors);
    }

    // Walks to a leaf. `share`: also to one that another worker is expanding. `first`: the move
    // that an expanded root must be left by, one of its edges'.
    Gathered gather(Leaf<G>& leaf, bool share, std::optional<engine::Move> first = {}) {
        leaf.game = root_;
        leaf.path.assign(1, tree_.root());
        leaf.line.clear();
        leaf.expands = false;
        tree_.enter_root();
        const bool arrived =
            std::visit([&](const auto& rule) { return descend(leaf, rule, first); }, rule_);
        if (!arrived) return tree_.withdraw(leaf.path), Gathered::full;
        const NodeId node = leaf.path.back();
        const auto ending = ending_of(leaf);
        if (ending == Ending::none) return prepare(leaf, node, share);
        const float value = value_of(ending, leaf.game.to_play());
        tree_.back_up(leaf.path, value, ending == Ending::draw ? 1.0f : 0.0f);
        return Gathered::absorbed;
    }

    // False when the tree is full: the value counts, but the leaf stays a leaf.
    bool absorb(Leaf<G>& leaf) {
        if (leaf.expands && leaf.path.size() == 1) prefer_mate(leaf);
        const bool fits = !leaf.expands || tree_.expand(leaf.path.back(), leaf.moves, leaf.priors);
        leaf.value =
            std::clamp(leaf.value + leaf.draws * draw_value(leaf.game.to_play()), -1.0f, 1.0f);
        if (std::holds_alternative<Rave>(rule_)) spread_amaf(leaf);
        tree_.back_up(leaf.path, leaf.value, leaf.draws);
        return fits;
    }

    // What a network said of a leaf since it was absorbed.
    void absorb_late(const Leaf<G>& leaf) {
        if (!leaf.priors.empty()) tree_.set_priors(leaf.path.back(), leaf.priors);
        tree_.add_network_value(leaf.path, std::clamp(leaf.value, -1.0f, 1.0f));
    }

    // Undoes gather() for a leaf that could not be evaluated.
    void abandon(const Leaf<G>& leaf) {
        if (leaf.expands) tree_.unclaim(leaf.path.back());
        tree_.withdraw(leaf.path);
    }

   private:
    bool is_alphago() const { return network_ && params_.method == Method::alphago; }
    float blend() const { return is_alphago() ? params_.lambda : 1; }

    static Rule rule_of(const SearchParams& params, bool network) {
        constexpr bool weighs = engine::WeighsMoves<typename engine::RolloutsOf<G>::type, G>;
        if (network && params.method == Method::alphago)
            return TwoCounts{params.alphago_cpuct, params.lambda, params.alphago_virtual_loss};
        if (network)
            return Puct{params.cpuct,         params.cpuct_factor,       params.cpuct_base,
                        params.fpu_reduction, params.root_fpu_reduction, params.virtual_loss};
        if (params.rave > 0)
            return Rave{{params.rave_exploration, params.unvisited},
                        params.rave,
                        weighs ? params.prior_visits : 0};
        return Ucb1{params.exploration, params.unvisited};
    }

    // From the leaf up, so that a move of the descent counts before any later one on its point.
    void spread_amaf(Leaf<G>& leaf) {
        const bool first = leaf.game.to_play() == engine::Player::first;
        float value = leaf.value;
        int mover = first ? 1 : -1;
        for (auto i = leaf.line.size() + 1; i-- > 0;) {
            if (i < leaf.line.size()) {
                value = -value;
                mover = -mover;
                const auto code = leaf.line[i].code;
                if (code < leaf.firsts.size()) leaf.firsts[code] = static_cast<std::int8_t>(mover);
            }
            if (tree_[leaf.path[i]].expanded())
                tree_.add_amaf(leaf.path[i], leaf.firsts, mover, value);
        }
    }

    Edge* edge_of(engine::Move move) {
        const auto edges = tree_.edges_to_enter(tree_.root());
        const auto edge = std::ranges::find(edges, move, &Edge::move);
        assert(edge != edges.end());  // The root's own plan names only the root's moves.
        return &*edge;
    }

    template <class SelectionRule>
    Edge* leave_root(const SelectionRule& rule, std::optional<engine::Move> first) {
        return first ? edge_of(*first) : select(tree_, tree_.root(), rule, filter_);
    }

    template <class SelectionRule>
    bool descend(Leaf<G>& leaf, const SelectionRule& rule, std::optional<engine::Move> first) {
        const Node& root = tree_[tree_.root()];
        if constexpr (std::is_same_v<SelectionRule, Rave>)
            return walk(leaf, rule.sized(root.visits.load(relaxed)), first);
        else
            return walk(leaf, rule, first);
    }

    template <class SelectionRule>
    bool walk(Leaf<G>& leaf, const SelectionRule& rule, std::optional<engine::Move> first) {
        NodeId node = tree_.root();
        while (tree_[node].expanded() && (node == tree_.root() || !tree_[node].decided())) {
            Edge* edge = node == tree_.root()
                             ? leave_root(rule, first)
                             : select(tree_, node, rule, [](engine::Move) { return true; });
            if (!edge) return true;
            const NodeId child = tree_.enter(*edge);
            if (child == no_node) return false;
            if (tree_[child].expanded()) tree_.prefetch_edges(child);
            leaf.game.play(edge->move);
            leaf.line.push_back(edge->move);
            leaf.path.push_back(node = child);
        }
        return true;
    }

    Gathered prepare(Leaf<G>& leaf, NodeId node, bool share) {
        const auto visits = tree_[node].visits.load(relaxed);
        const auto wanted = static_cast<std::uint32_t>(visits_to_expand_.load(relaxed));
        const bool due = node == tree_.root() || visits + 1 >= wanted;
        leaf.expands = due && tree_.claim(node);
        if (due && !leaf.expands && !share) return tree_.withdraw(leaf.path), Gathered::taken;
        if (leaf.expands) leaf.moves = sensible_moves(leaf.game, network_ || node == tree_.root());
        return Gathered::leaf;
    }

    // Legal moves without those that fill an own eye, which no rollout would play either. At the
    // root they stay: someone may ask for them. A network has a word on each.
    static engine::MoveList sensible_moves(const G& game, bool all) {
        auto moves = game.legal_moves();
        if constexpr (requires(engine::Move move) { game.fills_own_eye(move); })
            if (!all) moves.filter([&](engine::Move move) { return !game.fills_own_eye(move); });
        return moves;
    }

    Ending ending_of(const Leaf<G>& leaf) {
        const NodeId node = leaf.path.back();
        auto ending = tree_[node].ending.load(relaxed);
        if (ending != Ending::unknown) return ending;
        const auto outcome = leaf.game.outcome();
        ending = outcome == engine::Outcome::ongoing               ? Ending::none
                 : outcome == engine::Outcome::draw                ? Ending::draw
                 : outcome == engine::win_for(leaf.game.to_play()) ? Ending::win
                                                                   : Ending::loss;
        // A game that may be played on is searched at the root, where a move is asked for.
        if (node == tree_.root() && !leaf.game.legal_moves().empty()) ending = Ending::none;
        int plies = 0;
        if (ending == Ending::none && node != tree_.root())
            if (const auto mate = near_mate(leaf.game)) {
                ending = mate->mates ? Ending::win : Ending::loss;
                plies = mate->plies;
            }
        tree_.mark(node, ending, plies);
        if (params_.solver && Node::decides(ending)) tree_.prove(leaf.path, lists_all());
        return ending;
    }

    std::optional<engine::ForcedMate> near_mate(const G& game) const {
        if constexpr (requires { game.forced_mate(); })
            if (params_.solver) return game.forced_mate();
        return std::nullopt;
    }

    // At the root it takes more than to know that there is a mate: its move is tried first, however
    // little the network thinks of it.
    void prefer_mate(Leaf<G>& leaf) const {
        const auto mate = near_mate(leaf.game);
        if (!mate || !mate->mates || leaf.priors.empty()) return;
        for (int i = 0; float& prior : leaf.priors)
            prior = (prior + (leaf.moves[i++] == mate->move ? 1.0f : 0.0f)) / 2;
    }

    // Whether sensible_moves() are all legal ones below the root as well.
    bool lists_all() const {
        constexpr bool leaves_out = requires(const G& game, engine::Move move) {
            game.fills_own_eye(move);
        };
        return network_ || !leaves_out;
    }

    float draw_value(engine::Player mover) const {
        return mover == favoured_ ? params_.draw_score : -params_.draw_score;
    }
    float value_of(Ending ending, engine::Player mover) const {
        if (ending == Ending::draw) return draw_value(mover);
        return ending == Ending::win ? 1.0f : -1.0f;
    }

    SearchParams params_;
    bool network_;
    Rule rule_;
    std::atomic<int> visits_to_expand_ = 1;  // a leaf's, when it gets children
    G root_;
    Tree tree_;
    MoveFilter filter_;
    engine::Player favoured_ = engine::Player::first;
};

}  // namespace search
