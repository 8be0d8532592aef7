// The search tree under a memory budget that it never exceeds. It knows moves only as codes: no
// game is named here, so it is compiled once and tested without one.
//
// Threads share it without locks. A descent raises in_flight on every node it passes (the
// virtual loss); whoever moves a node from fresh to claimed is alone in expanding it.
//
// The budget is two equal halves. Nodes are made in the active one; when it is full, the callers
// of everything here meet without a descent among them, and one calls flip(): the other half,
// emptied, becomes active. What lies in the passive half is read, never written, and is copied
// over when a descent enters it; so the parts least recently visited are what the next flip
// forgets. enter() and expand() say when it is time.
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/game.h"
#include "search/memory.h"
#include "search/relaxed.h"

namespace search {

using NodeId = std::uint32_t;  // in units of 8 bytes from the start of the budget
inline constexpr NodeId no_node = 0;

// The mean of numbers in [0, 1] in 16 bits, one sample after another; of two threads that add at
// once one may be lost. What a step is too small for is made up for by a dither that depends on the
// number of samples alone, so that one thread gives one mean.
class SmallMean {
   public:
    void add(float sample, std::uint32_t count);  // `count`: samples, this one included
    float value() const { return static_cast<float>(packed_.load(relaxed)) / most; }
    void copy(const SmallMean& other) { packed_.store(other.packed_.load(relaxed), relaxed); }

   private:
    static constexpr float most = 65535;
    std::atomic<std::uint16_t> packed_ = 0;
};

// Values in sums: exact, and so the same in any order of addition, for 2^38 visits.
inline constexpr double value_unit = 1 << 24;
inline std::int64_t fixed_point(float value) {
    return static_cast<std::int64_t>(static_cast<double>(value) * value_unit);
}

// A prior in 16 bits: 5 of exponent, 11 of mantissa, from 2^-31 to 1.
inline constexpr std::uint32_t least_prior_exponent = 96;  // 2^-31 in the bits of a float
inline std::uint16_t pack_prior(float prior) {
    const auto bits = std::bit_cast<std::uint32_t>(std::clamp(prior, 0.0f, 1.0f)) + (1u << 11);
    const auto least = least_prior_exponent << 23;
    return bits < least ? std::uint16_t{0} : static_cast<std::uint16_t>((bits - least) >> 12);
}
inline float unpack_prior(std::uint16_t packed) {
    if (packed == 0) return 0;
    return std::bit_cast<float>((std::uint32_t{packed} << 12) + (least_prior_exponent << 23));
}

// How rollouts ended in which a move was made at any time by the player whose turn it is here, and
// not first by the other (all moves as first, AMAF). Halved when the count is full, so old rollouts
// fade; of two threads that add at once one may be lost.
class AmafCount {
   public:
    void add(float value);  // as the mover sees it
    std::uint32_t visits() const { return packed_.load(relaxed) >> 16; }
    float mean() const;  // 0 without visits
    void copy(const AmafCount& other) { packed_.store(other.packed_.load(), relaxed); }

   private:
    static constexpr std::uint32_t most_visits = 30000;
    std::atomic<std::uint32_t> packed_ = 0;  // visits above, twice the wins below
};

struct Edge {
    std::atomic<NodeId> child = no_node;
    engine::Move move;
    std::atomic<std::uint16_t> packed_prior = 0;
    AmafCount amaf;

    float prior() const { return unpack_prior(packed_prior.load(relaxed)); }
};
static_assert(sizeof(Edge) <= 12);

enum class Stage : std::uint8_t { fresh, claimed, expanded };

// The end of the game at a node, or what it is sure to come to, as the player to move there sees
// it.
enum class Ending : std::uint8_t { unknown, none, draw, win, loss };

struct Node {
    std::atomic<std::int64_t> value_sum = 0;    // as the player who moved here sees it
    std::atomic<std::int64_t> network_sum = 0;  // likewise, where networks count apart (AlphaGo)
    std::atomic<std::uint32_t> visits = 0;
    std::atomic<std::uint32_t> network_visits = 0;
    NodeId first_edge = no_node;
    std::uint16_t edge_count : 15 = 0;
    std::uint16_t in_order : 1 = 0;
    std::atomic<std::uint16_t> in_flight = 0;
    std::atomic<Stage> stage = Stage::fresh;
    std::atomic<Ending> ending = Ending::unknown;
    std::atomic<std::uint16_t> plies = 0;  // to the end, where it is sure
    SmallMean squares;                     // of the values
    SmallMean draws;                       // how likely a draw was said to be

    bool decided() const { return decides(ending.load(relaxed)); }
    static bool decides(Ending ending) { return ending > Ending::none; }
    bool expanded() const { return stage.load(std::memory_order_acquire) == Stage::expanded; }
    // Mean value over the finished visits and `losses` more, each counted as lost; 0 without any.
    float mean(double losses = 0) const {
        const double n = visits.load(relaxed) + losses;
        if (n == 0) return 0;
        const auto sum = static_cast<double>(value_sum.load(relaxed));
        return static_cast<float>((sum / value_unit - losses) / n);
    }
    // AlphaGo's: lambda times the above and the rest the mean of what networks said; one of them
    // alone where the other is not known yet.
    float blended(float lambda, double losses = 0) const {
        const auto said = network_visits.load(relaxed);
        if (said == 0) return mean(losses);
        const auto sum = static_cast<double>(network_sum.load(relaxed));
        const auto value = static_cast<float>(sum / value_unit / said);
        return lambda * mean(losses) + (1 - lambda) * value;
    }
    // Of the values about their mean, of at least two visits; 0 below.
    float variance() const;
};
static_assert(sizeof(Node) <= 40);

using Path = std::vector<NodeId>;

class Tree {
   public:
    // Reserves the address space; memory is taken as the tree grows. Fails with engine::Error
    // when the system grants not even the least budget.
    explicit Tree(std::size_t budget_bytes);
    Tree(const Tree&) = delete;
    Tree& operator=(const Tree&) = delete;

    // From now on values are Node::blended with this share, 1 being Node::mean.
    void set_blend(float lambda) { blend_ = lambda; }
    float value(const Node& node) const { return blend_ == 1 ? node.mean() : node.blended(blend_); }

    NodeId root() const { return root_; }
    const Node& operator[](NodeId id) const { return node(id); }
    std::span<const Edge> edges(NodeId id) const { return edge_span(node(id)); }
    // Whether the highest priors come first, and no child of an edge has been forgotten.
    bool in_order(NodeId id) const { return node(id).in_order; }
    // The child that `edge` of `parent` leads to, no_node when there is none (any more).
    NodeId child(NodeId parent, const Edge& edge) const;
    double share_used() const;  // of the budget, 0..1

    // The descent: enter_root(), then of an expanded node's edges(), enter(), to a leaf.
    std::span<Edge> edges_to_enter(NodeId id) { return edge_span(node(id)); }
    void enter_root() { node(root_).in_flight.fetch_add(1, relaxed); }
    // Makes the node on the first visit. no_node: full, withdraw and flip.
    NodeId enter(Edge& edge);
    // Has memory that will be read soon come nearer: a node, or an expanded node's first edges.
    void prefetch(NodeId id) const {
        __builtin_prefetch(base_ + id * unit);
        __builtin_prefetch(base_ + id * unit + sizeof(Node) - 1);
    }
    void prefetch_edges(NodeId id) const {
        const auto* edges = base_ + node(id).first_edge * unit;
        for (std::size_t line = 0; line < 4; ++line) __builtin_prefetch(edges + line * 64);
    }

    // What is known already stands. `plies`: to the end.
    void mark(NodeId id, Ending ending, int plies = 0);
    // Forgets the end of the game there: it is to be searched all the same.
    void unmark(NodeId id);
    // The end of a path has just been marked as decided: marks what follows for those before it but
    // the root (MCTS-solver, Winands et al. 2008). `lists_all`: the edges are all legal moves.
    void prove(const Path& path, bool lists_all);
    // True for exactly one caller, who must then expand() or unclaim() the node.
    bool claim(NodeId id);
    void unclaim(NodeId id) { node(id).stage.store(Stage::fresh, std::memory_order_release); }
    // `priors`: one a move, or empty for equal ones. False: full, and the node is fresh again.
    bool expand(NodeId id, const engine::MoveList& moves, std::span<const float> priors);

    // Ends a descent: records `value`, as the player to move at the path's end sees it, and how
    // likely a draw is.
    void back_up(const Path& path, float value, float draws = 0);
    // Records in the edges of an expanded node what a rollout of `value`, as the mover sees it,
    // says of moves made later: `firsts` by move code as engine::RolloutResult, `mover` as there.
    void add_amaf(NodeId id, std::span<const std::int8_t> firsts, int mover, float value);
    // What a network says later of the end of a path whose descent has ended, and its priors there,
    // one a move. Since then no flip() may have been.
    void add_network_value(const Path& path, float value);
    void set_priors(NodeId id, std::span<const float> priors);
    // Ends a descent that came to nothing.
    void withdraw(const Path& path);

    // The rest with no descent under way. Readers, too, must be kept out by the caller.
    void flip();
    void clear();
    // One a move of the expanded root, in the order of its edges.
    void replace_root_priors(std::span<const float> priors);
    // Makes the root's child by `move` the root; false (and the tree unchanged) without one.
    bool advance(engine::Move move);

   private:
    static constexpr std::size_t unit = 8;

    Node& node(NodeId id) const { return *reinterpret_cast<Node*>(base_ + id * unit); }
    std::span<Edge> edge_span(const Node& node) const {
        return {reinterpret_cast<Edge*>(base_ + node.first_edge * unit), node.edge_count};
    }
    bool active(NodeId id) const { return (id >= half_units_) == (active_half_ == 1); }
    NodeId allocate(std::size_t units, std::size_t reserve);
    NodeId copy(NodeId passive, std::size_t reserve);
    bool settle(NodeId parent, const Node& child, bool lists_all);
    void activate(int half);

    Memory memory_;
    std::byte* base_;
    std::size_t half_units_;
    int active_half_ = 0;
    std::size_t end_ = 0;           // of the active half
    std::size_t passive_used_ = 0;  // units
    std::atomic<std::size_t> next_ = 0;
    NodeId root_ = no_node;
    float blend_ = 1;
};

}  // namespace search
