// AlphaGo's networks together, as a search asks them: priors from a policy network, the value from
// a value network, rollouts by a linear policy. A folder holds them:
//   policy.safetensors   the supervised policy
//   rl.safetensors       the reinforced policy; may be absent
//   value.safetensors    the value network; where absent rollouts alone are the value
//   rollout.safetensors  the linear policies; where absent the search's own play rollouts
// as `sanban learn` makes them one by one.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "engine/go/go.h"
#include "engine/go/linear_policy.h"
#include "engine/go/rollouts.h"
#include "search/evaluator.h"
#include "search/network.h"

namespace search {

struct AlphaGoSet {
    std::shared_ptr<const Network> supervised, reinforced, value;  // but the first or nothing
    std::shared_ptr<const go::LinearPolicies> linear;              // or nothing
};

class AlphaGoSource final : public EvaluatorSource<go::Go> {
   public:
    // Fails with engine::Error when the networks do not fit each other.
    explicit AlphaGoSource(AlphaGoSet set);

    std::unique_ptr<Evaluator<go::Go>> make_evaluator() const override {
        return make_evaluator_of(Prior::supervised);
    }
    // Fails with engine::Error when the set has no such policy.
    std::unique_ptr<Evaluator<go::Go>> make_evaluator_of(Prior prior) const override;
    std::unique_ptr<RolloutPlayer<go::Go>> make_rollouts() const override;
    std::string_view name() const override { return set_.supervised->graph().facts.name; }
    bool has_value() const override { return set_.value != nullptr; }
    bool blends() const override { return true; }
    void check(const go::Go& game) const override;
    int policy_index(const go::Go& game, engine::Move move) const override;

   private:
    AlphaGoSet set_;
};

// Fails with engine::Error, one line, on a folder that lacks a network or holds another. Precisions
// are as for load_network.
std::shared_ptr<const AlphaGoSource> load_alphago(const std::filesystem::path& folder,
                                                  PrecisionChoice precision, const go::Go& game);
// The set that this program carries (embedded_alphago).
std::shared_ptr<const AlphaGoSource> load_embedded_alphago(PrecisionChoice precision,
                                                           const go::Go& game);

}  // namespace search
