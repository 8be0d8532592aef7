// A decorator that remembers answers by all that they depend on: what the encoding reads, the moves
// asked about, and the symmetry. Evaluators on several threads may share one cache.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "engine/encoding.h"
#include "search/evaluation_cache.h"
#include "search/evaluator.h"

namespace search {

template <engine::Game G>
class CachedEvaluator final : public Evaluator<G> {
   public:
    CachedEvaluator(std::unique_ptr<Evaluator<G>> inner, std::shared_ptr<EvaluationCache> cache)
        : inner_(std::move(inner)), cache_(std::move(cache)) {}

    void evaluate(std::span<const Query<G>> queries) override {
        missed_.clear();
        keys_.clear();
        for (const auto& query : queries) {
            const auto key = key_of(query);
            if (cache_->load(key, *query.answer) &&
                query.answer->priors.size() == static_cast<std::size_t>(query.moves->size()))
                continue;
            missed_.push_back(query);
            keys_.push_back(key);
        }
        if (missed_.empty()) return;
        inner_->evaluate(missed_);
        for (std::size_t i = 0; i < missed_.size(); ++i)
            cache_->store(keys_[i], *missed_[i].answer);
    }
    int symmetries(const G& game) const override { return inner_->symmetries(game); }
    std::uint64_t key(const G& game) const override { return inner_->key(game); }
    void warm_up(const G& game, int most) override { inner_->warm_up(game, most); }

   private:
    std::uint64_t key_of(const Query<G>& query) const {
        auto key =
            engine::mixed(inner_->key(*query.game), static_cast<std::uint64_t>(query.symmetry));
        for (const engine::Move move : *query.moves) key = engine::mixed(key, move.code);
        return key;
    }

    std::unique_ptr<Evaluator<G>> inner_;
    std::shared_ptr<EvaluationCache> cache_;
    std::vector<Query<G>> missed_;
    std::vector<std::uint64_t> keys_;
};

}  // namespace search
