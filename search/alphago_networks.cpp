#include "search/alphago_networks.h"

#include <fmt/format.h>

#include <optional>
#include <string_view>
#include <vector>

#include "engine/base/error.h"
#include "search/linear_network.h"
#include "search/load_network.h"

namespace search {

namespace {

using engine::fail;
using go::Go;
namespace fs = std::filesystem;

class PairEvaluator final : public Evaluator<Go> {
   public:
    PairEvaluator(std::shared_ptr<const Network> policy, std::shared_ptr<const Network> value)
        : policy_(std::move(policy)), value_(std::move(value)) {}

    void evaluate(std::span<const Query<Go>> queries) override {
        policy_.evaluate(queries);
        values_.resize(queries.size());
        asked_.assign(queries.begin(), queries.end());
        for (std::size_t i = 0; i < queries.size(); ++i) asked_[i].answer = &values_[i];
        value_.evaluate(asked_);
        for (std::size_t i = 0; i < queries.size(); ++i) {
            auto& answer = *queries[i].answer;
            answer.win = values_[i].win;
            answer.loss = values_[i].loss;
            answer.draw = values_[i].draw;
        }
    }
    int symmetries(const Go& game) const override { return policy_.symmetries(game); }
    std::uint64_t key(const Go& game) const override { return policy_.key(game); }
    void warm_up(const Go& game, int most) override {
        policy_.warm_up(game, most);
        value_.warm_up(game, most);
    }

   private:
    NetworkEvaluator<Go> policy_, value_;
    std::vector<Evaluation> values_;
    std::vector<Query<Go>> asked_;
};

void check_kind(const Network& network, const char* output, int board) {
    const auto& facts = network.graph().facts;
    if (facts.game != Go::name || !network.graph().output(output))
        fail("the network {} is no {} network of Go", facts.name, output);
    if (facts.board != board)
        fail("the network {} is for boards of {}, another of the set for {}", facts.name,
             facts.board, board);
    engine::find_encoding<Go>(facts.encoding);
}

// The networks that a folder holds, as it holds them.
struct ExactSet {
    explicit ExactSet(const fs::path& folder)
        : policy(in(folder, "policy")),
          value(if_in(folder, "value")),
          reinforced(if_in(folder, "rl")) {
        if (const auto file = folder / file_of("rollout"); fs::exists(file))
            linear = load_linear_policies(file.string());
    }

    AlphaGoSet as_it_is() const {
        return {policy.network, reinforced ? reinforced->network : nullptr,
                value ? value->network : nullptr, linear};
    }

    loading::Exact policy;
    std::optional<loading::Exact> value, reinforced;
    std::shared_ptr<const go::LinearPolicies> linear;

   private:
    static std::string file_of(std::string_view name) {
        return fmt::format("{}.safetensors", name);
    }
    static loading::Exact in(const fs::path& folder, std::string_view name) {
        const auto file = folder / file_of(name);
        if (!fs::exists(file))
            fail("{}: expected AlphaGo's networks there, found no {}", folder.string(),
                 file_of(name));
        return loading::Exact(loading::contents_of(file));
    }
    static std::optional<loading::Exact> if_in(const fs::path& folder, std::string_view name) {
        if (!fs::exists(folder / file_of(name))) return std::nullopt;
        return in(folder, name);
    }
};

}  // namespace

AlphaGoSource::AlphaGoSource(AlphaGoSet set) : set_(std::move(set)) {
    const int board = set_.supervised->graph().facts.board;
    check_kind(*set_.supervised, "policy", board);
    if (set_.reinforced) check_kind(*set_.reinforced, "policy", board);
    if (set_.value) check_kind(*set_.value, "value", board);
}

std::unique_ptr<Evaluator<Go>> AlphaGoSource::make_evaluator_of(Prior prior) const {
    const auto& policy = prior == Prior::supervised ? set_.supervised : set_.reinforced;
    if (!policy) fail("the set of networks has no reinforced policy (rl.safetensors)");
    if (!set_.value) return std::make_unique<NetworkEvaluator<Go>>(policy);
    return std::make_unique<PairEvaluator>(policy, set_.value);
}

std::unique_ptr<RolloutPlayer<Go>> AlphaGoSource::make_rollouts() const {
    if (!set_.linear) return EvaluatorSource<Go>::make_rollouts();
    return std::make_unique<RolloutPlayerBy<Go, go::LinearRollouts>>(set_.linear);
}

void AlphaGoSource::check(const Go& game) const {
    const int board = set_.supervised->graph().facts.board;
    if (board != 0 && board != game.size())
        fail("the network {} is for boards of {}x{}, not {}x{}", name(), board, board, game.size(),
             game.size());
}

int AlphaGoSource::policy_index(const Go& game, engine::Move move) const {
    return engine::find_encoding<Go>(set_.supervised->graph().facts.encoding)
        .policy_index(game, move);
}

std::shared_ptr<const AlphaGoSource> load_alphago(const fs::path& folder, PrecisionChoice precision,
                                                  const Go& game) {
    const ExactSet exact(folder);
    auto set = exact.as_it_is();
    AlphaGoSource(set).check(game);
    const auto player = exact.policy.network;
    set.supervised = loading::settled(exact.policy, player, precision, game);
    if (exact.value) set.value = loading::settled(*exact.value, player, precision, game);
    if (exact.reinforced)
        set.reinforced = loading::settled(*exact.reinforced, player, precision, game);
    return std::make_shared<const AlphaGoSource>(std::move(set));
}

}  // namespace search
