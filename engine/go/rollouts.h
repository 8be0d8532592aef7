// Games of Go played out on a board of their own: neither player fills its own one-point eyes, both
// pass only when nothing else is left, and the stones on the board are scored. One a thread.
#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "engine/go/go.h"
#include "engine/rollout.h"

namespace go {

// What the two kinds share: a rollout of any board size and its result.
template <class Policy>
class RolloutsBy {
   public:
    explicit RolloutsBy(std::shared_ptr<const Policy> policy = nullptr)
        : policy_(std::move(policy)) {}

    // Superko is not looked at, and a rollout of 3 * size * size moves is cut off and scored as it
    // stands. Under territory rules the lead is the area's less what Black played more than White
    // before the rollout. A finished game has its own result.
    engine::RolloutResult play(const Go& from, engine::Random& random);

   protected:
    const Policy& policy() const { return *policy_; }

   private:
    template <int most_size>
    int play_on(const Go& from, engine::Random& random);
    engine::RolloutResult finished(const Go& game);

    std::shared_ptr<const Policy> policy_;  // where it has something to say
    std::array<std::int8_t, most_points> owners_;
    std::array<std::int8_t, (max_size + 1) * (max_size + 1)> firsts_{};  // by index, edges 0
};

// Uniformly random moves.
struct AtRandom;
class RandomRollouts : public RolloutsBy<AtRandom> {};

// Moves by policy (rollout_policy.h), as the search plays them.
struct ByPolicy;
class Rollouts : public RolloutsBy<ByPolicy> {
   public:
    // How good the moves of `game` look to the policy: positive, 1 that of a move of which nothing
    // is known; one a move.
    void weigh(const Go& game, const MoveList& moves, std::vector<float>& weights) const;
};

// Moves by AlphaGo's rollout policy (linear_policy.h).
struct LinearPolicies;
class LinearRollouts : public RolloutsBy<LinearPolicies> {
   public:
    using RolloutsBy::RolloutsBy;
    // How likely the tree policy is to play each of the moves of `game`; they sum to about 1. What
    // it never plays is given a little.
    void weigh(const Go& game, const MoveList& moves, std::vector<float>& weights) const;
};

}  // namespace go
