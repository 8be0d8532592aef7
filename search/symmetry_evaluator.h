// A decorator that settles which symmetry a network sees: one drawn for each evaluation, or the
// average over all. Where the game has none, every query is answered as it stands.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/random.h"
#include "search/answer.h"
#include "search/evaluator.h"

namespace search {

template <engine::Game G>
class SymmetryEvaluator final : public Evaluator<G> {
   public:
    SymmetryEvaluator(std::unique_ptr<Evaluator<G>> inner, std::uint64_t seed)
        : inner_(std::move(inner)), random_(seed) {}

    void evaluate(std::span<const Query<G>> queries) override {
        single_.clear();
        for (const auto& query : queries) {
            if (query.symmetry == all_symmetries && inner_->symmetries(*query.game) > 1)
                average(query);
            else
                single_.push_back(settled_query(query));
        }
        if (!single_.empty()) inner_->evaluate(single_);
    }
    int symmetries(const G& game) const override { return inner_->symmetries(game); }
    std::uint64_t key(const G& game) const override { return inner_->key(game); }
    void warm_up(const G& game, int most) override { inner_->warm_up(game, most); }

   private:
    Query<G> settled_query(Query<G> query) {
        const int count = inner_->symmetries(*query.game);
        if (query.symmetry < 0) query.symmetry = count > 1 ? random_.below(count) : 0;
        if (query.symmetry >= count) query.symmetry = 0;
        return query;
    }

    void average(const Query<G>& query) {
        const int count = inner_->symmetries(*query.game);
        parts_.resize(static_cast<std::size_t>(count));
        turned_.clear();
        for (int symmetry = 0; symmetry < count; ++symmetry)
            turned_.push_back(
                {query.game, query.moves, symmetry, &parts_[static_cast<std::size_t>(symmetry)]});
        inner_->evaluate(turned_);
        *query.answer = {};
        for (const auto& part : parts_)
            add_weighted(part, 1 / static_cast<float>(count), *query.answer);
    }

    std::unique_ptr<Evaluator<G>> inner_;
    engine::Random random_;
    std::vector<Query<G>> single_, turned_;
    std::vector<Evaluation> parts_;
};

}  // namespace search
