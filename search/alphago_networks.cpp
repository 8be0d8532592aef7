#include "search/alphago_networks.h"

#include <algorithm>
#include <vector>

#include "engine/base/error.h"
#include "nn/load.h"
#include "search/linear_network.h"
#include "search/network_evaluator.h"

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

std::shared_ptr<const Network> network_in(const fs::path& file, nn::Precision precision) {
    auto graph = nn::load(file);
    if (graph.facts.name.empty()) graph.facts.name = file.filename().string();
    return std::make_shared<const Network>(std::move(graph), precision);
}

}  // namespace

AlphaGoSource::AlphaGoSource(AlphaGoSet set) : set_(std::move(set)) {
    const int board = set_.supervised->graph().facts.board;
    check_kind(*set_.supervised, "policy", board);
    if (set_.reinforced) check_kind(*set_.reinforced, "policy", board);
    check_kind(*set_.value, "value", board);
}

std::unique_ptr<Evaluator<Go>> AlphaGoSource::make_evaluator_of(Prior prior) const {
    const auto& policy = prior == Prior::supervised ? set_.supervised : set_.reinforced;
    if (!policy) fail("the set of networks has no reinforced policy (rl.safetensors)");
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
    const auto wanted = std::min(precision.value_or(nn::Precision::bf16), nn::Precision::bf16);
    const auto optional = [&](const char* name) { return fs::exists(folder / name); };
    for (const char* name : {"policy.safetensors", "value.safetensors"})
        if (!optional(name))
            fail("{}: expected AlphaGo's networks there, found no {}", folder.string(), name);
    AlphaGoSet set;
    set.supervised = network_in(folder / "policy.safetensors", wanted);
    set.value = network_in(folder / "value.safetensors", wanted);
    if (optional("rl.safetensors")) set.reinforced = network_in(folder / "rl.safetensors", wanted);
    if (optional("rollout.safetensors"))
        set.linear = load_linear_policies((folder / "rollout.safetensors").string());
    auto source = std::make_shared<const AlphaGoSource>(std::move(set));
    source->check(game);
    return source;
}

}  // namespace search
