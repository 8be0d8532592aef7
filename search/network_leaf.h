// The leaf evaluator of AlphaGo Zero and AlphaZero: priors and value from a network, nothing
// played out. Priors come sorted, the highest first, which selection relies on for speed only.
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "search/evaluator.h"
#include "search/leaf.h"

namespace search {

template <engine::Game G>
class NetworkLeaf final : public LeafEvaluator<G> {
   public:
    // `average_root`: over all symmetries; elsewhere one is drawn for each evaluation.
    NetworkLeaf(std::unique_ptr<Evaluator<G>> evaluator, bool average_root)
        : evaluator_(std::move(evaluator)), average_root_(average_root) {}

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

   private:
    void absorb(const Evaluation& answer, Leaf<G>& leaf) {
        leaf.value = answer.value();
        const float sign = leaf.game.to_play() == engine::Player::first ? 1.0f : -1.0f;
        if (!answer.owners.empty()) tally_.add(answer.owners, answer[Figure::lead], sign);
        const auto count = static_cast<std::size_t>(leaf.moves.size());
        sorted_.clear();
        for (std::size_t i = 0; i < count; ++i)
            sorted_.emplace_back(answer.priors[i], leaf.moves[static_cast<int>(i)]);
        std::stable_sort(sorted_.begin(), sorted_.end(),
                         [](const auto& a, const auto& b) { return a.first > b.first; });
        leaf.moves.clear();
        leaf.priors.clear();
        for (const auto& [prior, move] : sorted_) {
            leaf.moves.push(move);
            leaf.priors.push_back(prior);
        }
    }

    std::unique_ptr<Evaluator<G>> evaluator_;
    bool average_root_;
    std::vector<Evaluation> answers_;
    std::vector<Query<G>> queries_;
    std::vector<std::pair<float, engine::Move>> sorted_;
    OwnerTally tally_;
};

}  // namespace search
