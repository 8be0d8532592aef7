#include "search/alphago_networks.h"

#include <fmt/format.h>

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/base/error.h"
#include "search/embedded_weights.h"
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

// Reads the network of this name (policy, rl, value, rollout), where there is one.
using Find = std::function<std::optional<nn::Contents>(std::string_view)>;

// The networks of a set, as its files have them.
struct ExactSet {
    // `where`: for the message when there is no policy network.
    ExactSet(std::string_view where, const Find& find)
        : policy(contents_of_policy(where, find)),
          value(exact(find("value"))),
          reinforced(exact(find("rl"))) {
        if (const auto contents = find("rollout")) try {
                linear = linear_policies_of(contents->graph);
            } catch (const engine::Error& error) {
                fail("{}/rollout.safetensors: {}", where, error.what());
            }
    }

    AlphaGoSet as_it_is() const {
        return {policy.network, reinforced ? reinforced->network : nullptr,
                value ? value->network : nullptr, linear};
    }

    loading::Exact policy;
    std::optional<loading::Exact> value, reinforced;
    std::shared_ptr<const go::LinearPolicies> linear;

   private:
    static nn::Contents contents_of_policy(std::string_view where, const Find& find) {
        auto contents = find("policy");
        if (!contents)
            fail("{}: expected AlphaGo's networks there, found no policy.safetensors", where);
        return std::move(*contents);
    }
    static std::optional<loading::Exact> exact(std::optional<nn::Contents> contents) {
        if (!contents) return std::nullopt;
        return loading::Exact(std::move(*contents));
    }
};

std::shared_ptr<const AlphaGoSource> source_of_set(const ExactSet& exact, PrecisionChoice precision,
                                                   const Go& game) {
    auto set = exact.as_it_is();
    AlphaGoSource(set).check(game);
    const auto player = exact.policy.network;
    set.supervised = loading::settled(exact.policy, player, precision, game);
    if (exact.value) set.value = loading::settled(*exact.value, player, precision, game);
    if (exact.reinforced)
        set.reinforced = loading::settled(*exact.reinforced, player, precision, game);
    return std::make_shared<const AlphaGoSource>(std::move(set));
}

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
    const auto find = [&](std::string_view name) -> std::optional<nn::Contents> {
        const auto file = folder / fmt::format("{}.safetensors", name);
        if (!fs::exists(file)) return std::nullopt;
        return loading::contents_of(file);
    };
    return source_of_set(ExactSet(folder.string(), find), precision, game);
}

std::shared_ptr<const AlphaGoSource> load_embedded_alphago(PrecisionChoice precision,
                                                           const Go& game) {
    const auto find = [](std::string_view name) -> std::optional<nn::Contents> {
        const auto bytes = embedded_weights(fmt::format("{}/{}", embedded_alphago, name));
        if (bytes.empty()) return std::nullopt;
        return nn::contents_from_bytes(bytes);
    };
    return source_of_set(ExactSet(embedded_alphago, find), precision, game);
}

}  // namespace search
