// How a leaf of the tree is judged: by playing the game out, by a network, or by both. An
// evaluator belongs to one worker thread; what it has learnt of the points' owners may be read
// from any.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "engine/base/random.h"
#include "engine/game.h"
#include "engine/rollout.h"
#include "search/tree.h"

namespace search {

// One leaf, from the descent that found it to the back-up that absorbs it.
template <engine::Game G>
struct Leaf {
    G game;
    Path path;
    std::vector<engine::Move> line;   // from the root
    bool expands = false;             // this descent claimed the leaf and must expand it
    engine::MoveList moves;           // the legal ones, when it expands
    std::vector<float> priors;        // one a move, summing to 1, or empty for equal ones
    std::vector<std::int8_t> firsts;  // of a rollout, by move code (engine::RolloutResult)
    float value = 0;                  // as the player to move sees it
    float draws = 0;                  // how likely a draw is
};

// Sums over rollouts of who owned each point at the end, and by how much the first player led; over
// a network's answers likewise, and how many plies they expected the game to take. One thread adds,
// any thread reads.
class OwnerTally {
   public:
    static constexpr std::size_t most_points = 1024;
    static constexpr std::int64_t unit = 1 << 12;  // of an owner's sum

    void add(const engine::RolloutResult& result);
    // What a network expects, `sign` being 1 where the first player is to move, else -1.
    void add(std::span<const float> owners, float lead, float sign);
    void add_length(float plies);
    void reset();

    // Adds this tally to the sums of several.
    struct Sum {
        std::int64_t rollouts = 0, lengths = 0;  // rollouts: or answers
        double lead = 0, plies = 0;
        std::vector<double> owners;
    };
    void add_to(Sum& sum) const;

   private:
    std::atomic<std::int64_t> rollouts_ = 0, lengths_ = 0;
    std::atomic<double> lead_ = 0, plies_ = 0;
    std::atomic<std::size_t> points_ = 0;
    std::array<std::atomic<std::int64_t>, most_points> owners_{};
};

template <engine::Game G>
class LeafEvaluator {
   public:
    virtual ~LeafEvaluator() = default;
    // Fills priors and value of each, and may reorder its moves.
    virtual void evaluate(std::span<Leaf<G>> leaves) = 0;
    // Whether it pays to judge a leaf that another worker is judging already.
    virtual bool shares_leaves() const = 0;
    virtual OwnerTally* tally() { return nullptr; }
    // Visits at which a leaf gets children; 0: as the search's params say. May change as time goes.
    virtual int visits_to_expand() const { return 0; }
    // Of a leaf that has been absorbed and has its children now: remembers to ask a network about
    // it, where priors and value come from one later.
    virtual void defer(const Leaf<G>&) {}
    // Leaves of which that has been asked since, by any worker: their priors and values. Valid
    // until the next call.
    virtual std::span<const Leaf<G>> judge_deferred() { return {}; }
    // As Evaluator's.
    virtual void warm_up(const G&, int /*most*/) {}
};

// The result, or what is expected of one that was not reached, as `mover` sees it.
inline float result_value(engine::Player mover, const engine::RolloutResult& result) {
    if (result.outcome != engine::Outcome::ongoing) return engine::value_for(mover, result.outcome);
    return mover == engine::Player::first ? result.expectation : -result.expectation;
}

// The same, and in games with points a little of the lead: of moves that all win, or all lose, the
// search is to find the best as well.
inline float rollout_value(engine::Player mover, const engine::RolloutResult& result) {
    constexpr float share = 0.1f;
    const float outcome = result_value(mover, result);
    if (result.owners.empty()) return outcome;
    const float all = result.lead / static_cast<float>(result.owners.size());
    const float lead = std::clamp(mover == engine::Player::first ? all : -all, -1.0f, 1.0f);
    return (1 - share) * outcome + share * lead;
}

// Monte Carlo: the result of one game played to the end. Priors are the rollout policy's where it
// weighs moves, else equal.
template <engine::Game G>
class RolloutLeaf final : public LeafEvaluator<G> {
   public:
    explicit RolloutLeaf(std::uint64_t seed) : random_(seed) {}

    void evaluate(std::span<Leaf<G>> leaves) override {
        for (Leaf<G>& leaf : leaves) {
            leaf.priors.clear();
            if (leaf.expands) {
                shuffle(leaf.moves);
                weigh(leaf);
            }
            roll_out(leaf);
        }
    }
    bool shares_leaves() const override { return true; }
    OwnerTally* tally() override { return &tally_; }

   private:
    using Rollouts = typename engine::RolloutsOf<G>::type;

    void roll_out(Leaf<G>& leaf) {
        const auto result = rollouts_.play(leaf.game, random_);
        tally_.add(result);
        leaf.firsts.assign(result.firsts.begin(), result.firsts.end());
        leaf.value = rollout_value(leaf.game.to_play(), result);
        leaf.draws = result.outcome == engine::Outcome::draw ? 1.0f : 0.0f;
    }

    void weigh(Leaf<G>& leaf) const {
        if constexpr (engine::WeighsMoves<Rollouts, G>) {
            rollouts_.weigh(leaf.game, leaf.moves, leaf.priors);
            const float sum = std::accumulate(leaf.priors.begin(), leaf.priors.end(), 0.0f);
            for (float& prior : leaf.priors) prior /= sum;
        }
    }

    // Unvisited moves are tried in the order of the list, which must not favour a corner.
    void shuffle(engine::MoveList& moves) {
        order_.clear();
        for (const engine::Move move : moves) order_.push_back(move);
        moves.clear();
        for (auto left = static_cast<int>(order_.size()); left > 0; --left) {
            auto& drawn = order_[static_cast<std::size_t>(random_.below(left))];
            moves.push(drawn);
            drawn = order_[static_cast<std::size_t>(left - 1)];
        }
    }

    Rollouts rollouts_;
    engine::Random random_;
    OwnerTally tally_;
    std::vector<engine::Move> order_;
};

}  // namespace search
