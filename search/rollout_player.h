// Games played out as a search asks for them, whoever knows how. One a thread.
#pragma once

#include <utility>
#include <vector>

#include "engine/rollout.h"

namespace search {

template <engine::Game G>
class RolloutPlayer {
   public:
    virtual ~RolloutPlayer() = default;
    virtual engine::RolloutResult play(const G& from, engine::Random& random) = 0;
    // How good the moves of `game` look: positive, one a move; empty where nothing is known of
    // them.
    virtual void weigh(const G& game, const engine::MoveList& moves,
                       std::vector<float>& weights) const = 0;
};

template <engine::Game G, class Rollouts>
class RolloutPlayerBy final : public RolloutPlayer<G> {
   public:
    // With what Rollouts are made of.
    template <class... Parts>
    explicit RolloutPlayerBy(Parts&&... parts) : rollouts_(std::forward<Parts>(parts)...) {}

    engine::RolloutResult play(const G& from, engine::Random& random) override {
        return rollouts_.play(from, random);
    }
    void weigh(const G& game, const engine::MoveList& moves,
               std::vector<float>& weights) const override {
        weights.clear();
        if constexpr (engine::WeighsMoves<Rollouts, G>) rollouts_.weigh(game, moves, weights);
    }

   private:
    Rollouts rollouts_;
};

}  // namespace search
