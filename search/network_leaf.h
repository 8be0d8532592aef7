// The leaf evaluator of AlphaGo Zero and AlphaZero: priors and value from a network; where that is
// not to be trusted with who lives at the end, or with what hangs, the position is played out
// besides (a game of Go, the captures of chess and shogi), and the value is blended as AlphaGo's
// (Silver et al. 2016). Priors come sorted, the highest first, which makes selection fast.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "search/evaluator.h"
#include "search/leaf.h"
#include "search/prior_sorter.h"
#include "search/rollout_player.h"

namespace search {

// Evens the priors out above a temperature of 1, sharpens them below.
inline void temper(std::vector<float>& priors, float temperature) {
    if (temperature == 1) return;
    float sum = 0;
    for (float& prior : priors) sum += prior = std::pow(prior, 1 / temperature);
    for (float& prior : priors) prior /= sum;
}

template <engine::Game G>
class NetworkLeaf final : public LeafEvaluator<G> {
   public:
    // `average_root`: over all symmetries; elsewhere one is drawn for each evaluation.
    // `temperatures`: of the policy, at the root and elsewhere; 1 leaves it as it is.
    struct Temperatures {
        float root = 1, elsewhere = 1;
    };
    // Every leaf played out, with a player, so many times that the mean is worth its share.
    struct Rollouts {
        Rollouts() = default;
        // None with a share of 0.
        Rollouts(const EvaluatorSource<G>& network, float of_value, int a_leaf,
                 std::uint64_t random_seed)
            : player(of_value > 0 ? network.make_rollouts() : nullptr),
              share(of_value),
              count(engine::playouts_vary<G> ? a_leaf : 1),
              seed(random_seed) {}

        std::unique_ptr<RolloutPlayer<G>> player;
        float share = 0;  // of a value; the rest is the network's
        int count = 1;    // a leaf
        std::uint64_t seed = 0;
    };
    NetworkLeaf(std::unique_ptr<Evaluator<G>> evaluator, bool average_root,
                Temperatures temperatures = {}, Rollouts rollouts = {})
        : evaluator_(std::move(evaluator)),
          average_root_(average_root),
          temperatures_(temperatures),
          rollouts_(std::move(rollouts)),
          random_(rollouts_.seed) {}

    void evaluate(std::span<Leaf<G>> leaves) override {
        answers_.resize(std::max(answers_.size(), leaves.size()));
        queries_.clear();
        for (std::size_t i = 0; i < leaves.size(); ++i) {
            // A leaf that another worker expands, or that waits for more visits, has no moves yet.
            if (!leaves[i].expands) leaves[i].moves.clear();
            const bool root = leaves[i].path.size() == 1;
            queries_.push_back({&leaves[i].game, &leaves[i].moves,
                                root && average_root_ ? all_symmetries : random_symmetry,
                                &answers_[i]});
        }
        evaluator_->evaluate(queries_);
        for (std::size_t i = 0; i < leaves.size(); ++i) absorb(answers_[i], leaves[i]);
    }
    bool shares_leaves() const override { return false; }
    OwnerTally* tally() override { return &tally_; }
    void warm_up(const G& game, int most) override { evaluator_->warm_up(game, most); }

   private:
    void absorb(Evaluation& answer, Leaf<G>& leaf) {
        leaf.value = answer.value();
        leaf.draws = answer.draw;
        if (rollouts_.player) roll_out(leaf);
        const float sign = leaf.game.to_play() == engine::Player::first ? 1.0f : -1.0f;
        if (!answer.owners.empty()) tally_.add(answer.owners, answer[Figure::lead], sign);
        if (const float left = answer[Figure::moves_left]; left > 0)
            tally_.add_length(left + static_cast<float>(leaf.line.size()));
        const bool root = leaf.path.size() == 1;
        temper(answer.priors, root ? temperatures_.root : temperatures_.elsewhere);
        sorter_.sort(answer.priors, leaf.moves);
        leaf.priors.swap(answer.priors);
    }

    void roll_out(Leaf<G>& leaf) {
        float sum = 0;
        for (int i = 0; i < rollouts_.count; ++i) {
            const auto result = rollouts_.player->play(leaf.game, random_);
            sum += rollout_value(leaf.game.to_play(), result);
        }
        const float played = sum / static_cast<float>(rollouts_.count);
        leaf.value += rollouts_.share * (played - leaf.value);
    }

    std::unique_ptr<Evaluator<G>> evaluator_;
    bool average_root_;
    Temperatures temperatures_;
    Rollouts rollouts_;
    engine::Random random_;
    std::vector<Evaluation> answers_;
    std::vector<Query<G>> queries_;
    PriorSorter sorter_;
    OwnerTally tally_;
};

}  // namespace search
