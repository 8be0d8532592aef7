// The leaf evaluator of AlphaGo (Silver et al. 2016): every leaf is played out at once, and one
// that gets children has the tree policy's priors until the networks have answered. What the
// networks are to be asked waits in a queue that all workers share; whoever finds a batch there
// asks it, so that rollouts and networks share the cores as the queue fills. How fast it fills is
// n_thr's to say, the visits at which a leaf gets children, which CoreShare sets by measurement.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "search/core_share.h"
#include "search/evaluator.h"
#include "search/leaf.h"
#include "search/network_leaf.h"

namespace search {

// Leaves that networks are to be asked about. From any thread.
template <engine::Game G>
class LateLeaves {
   public:
    // The root is not kept waiting for a batch.
    void push(const Leaf<G>& leaf) {
        const std::lock_guard lock(mutex_);
        urgent_ = urgent_ || leaf.path.size() == 1;
        leaves_.push_back(leaf);
    }
    // Overwrites `to` with a batch, or with nothing where there is none yet.
    void take(std::size_t batch, std::vector<Leaf<G>>& to) {
        to.clear();
        const std::lock_guard lock(mutex_);
        if (leaves_.empty() || (leaves_.size() < batch && !urgent_)) return;
        urgent_ = false;
        for (; to.size() < batch && !leaves_.empty(); leaves_.pop_front())
            to.push_back(std::move(leaves_.front()));
    }
    void clear() {
        const std::lock_guard lock(mutex_);
        leaves_.clear();
        urgent_ = false;
    }

   private:
    std::mutex mutex_;
    std::deque<Leaf<G>> leaves_;
    bool urgent_ = false;
};

struct AlphaGoParams {
    float lambda = 0.5f;        // 0: nothing is played out
    float temperature = 0.67f;  // of the networks' priors
    int batch = 1;              // leaves that the networks are asked about at once
    int n_thr = 0;              // visits at which a leaf gets children; 0: CoreShare says
};

template <engine::Game G>
class AlphaGoLeaf final : public LeafEvaluator<G> {
   public:
    AlphaGoLeaf(std::unique_ptr<Evaluator<G>> networks, std::unique_ptr<RolloutPlayer<G>> rollouts,
                std::shared_ptr<LateLeaves<G>> late, std::shared_ptr<CoreShare> share,
                const AlphaGoParams& params, std::uint64_t seed)
        : networks_(std::move(networks)),
          rollouts_(std::move(rollouts)),
          late_(std::move(late)),
          share_(std::move(share)),
          params_(params),
          random_(seed) {}

    void evaluate(std::span<Leaf<G>> leaves) override {
        const auto begun = Clock::now();
        for (Leaf<G>& leaf : leaves) {
            leaf.priors.clear();
            if (leaf.expands) weigh(leaf);
            roll_out(leaf);
        }
        share_->add_rollout(Clock::now() - begun);
    }
    // Where nothing is played out, a leaf without an answer has no value: none is to wait.
    int visits_to_expand() const override {
        if (params_.n_thr > 0) return params_.n_thr;
        return params_.lambda == 0 ? 1 : share_->visits_to_expand();
    }
    bool shares_leaves() const override { return true; }
    OwnerTally* tally() override { return &tally_; }
    void warm_up(const G& game, int /*most*/) override { networks_->warm_up(game, params_.batch); }

    void defer(const Leaf<G>& leaf) override { late_->push(leaf); }
    std::span<const Leaf<G>> judge_deferred() override {
        late_->take(static_cast<std::size_t>(params_.batch), judged_);
        if (judged_.empty()) return {};
        answers_.resize(judged_.size());
        std::vector<Query<G>> queries;
        for (std::size_t i = 0; i < judged_.size(); ++i)
            queries.push_back({&judged_[i].game, &judged_[i].moves, random_symmetry, &answers_[i]});
        const auto begun = Clock::now();
        networks_->evaluate(queries);
        share_->add_networks(Clock::now() - begun);
        for (std::size_t i = 0; i < judged_.size(); ++i) {
            temper(answers_[i].priors, params_.temperature);
            judged_[i].priors.swap(answers_[i].priors);
            judged_[i].value = answers_[i].value();
        }
        return judged_;
    }

   private:
    using Clock = std::chrono::steady_clock;

    void weigh(Leaf<G>& leaf) const {
        rollouts_->weigh(leaf.game, leaf.moves, leaf.priors);
        const float sum = std::accumulate(leaf.priors.begin(), leaf.priors.end(), 0.0f);
        for (float& prior : leaf.priors) prior /= sum;
    }

    void roll_out(Leaf<G>& leaf) {
        leaf.value = leaf.draws = 0;
        if (params_.lambda == 0) return;
        const auto result = rollouts_->play(leaf.game, random_);
        tally_.add(result);
        leaf.value = result_value(leaf.game.to_play(), result);
        leaf.draws = result.outcome == engine::Outcome::draw ? 1.0f : 0.0f;
    }

    std::unique_ptr<Evaluator<G>> networks_;
    std::unique_ptr<RolloutPlayer<G>> rollouts_;
    std::shared_ptr<LateLeaves<G>> late_;
    std::shared_ptr<CoreShare> share_;
    AlphaGoParams params_;
    engine::Random random_;
    OwnerTally tally_;
    std::vector<Leaf<G>> judged_;
    std::vector<Evaluation> answers_;
};

}  // namespace search
