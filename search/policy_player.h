// A policy network that plays without any search: of every position a move drawn from what it says,
// among those that are legal and fill no own eye; a pass where there is none. One thread.
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/random.h"
#include "search/network_evaluator.h"

namespace search {

template <engine::Encoded G>
class PolicyPlayer {
   public:
    explicit PolicyPlayer(std::shared_ptr<const Network> network)
        : evaluator_(std::move(network)) {}

    // Asks about at most `batch` positions at once. One move a game.
    std::vector<engine::Move> draw(std::span<const G* const> games, engine::Random& random) {
        std::vector<engine::Move> moves;
        while (!games.empty()) {
            const auto part = games.first(std::min(games.size(), batch));
            draw_part(part, random, moves);
            games = games.subspan(part.size());
        }
        return moves;
    }

    // Legal moves, a pass only where every other fills an own eye.
    static engine::MoveList sensible(const G& game) {
        auto moves = game.legal_moves();
        if constexpr (requires(engine::Move move) { game.fills_own_eye(move); }) {
            moves.filter(
                [&](engine::Move move) { return move != G::pass && !game.fills_own_eye(move); });
            if (moves.empty()) moves.push(G::pass);
        }
        return moves;
    }

   private:
    static constexpr std::size_t batch = 16;

    void draw_part(std::span<const G* const> games, engine::Random& random,
                   std::vector<engine::Move>& drawn) {
        lists_.resize(games.size());
        answers_.resize(games.size());
        queries_.clear();
        for (std::size_t i = 0; i < games.size(); ++i) {
            lists_[i] = sensible(*games[i]);
            queries_.push_back({games[i], &lists_[i], 0, &answers_[i]});
        }
        evaluator_.evaluate(queries_);
        for (std::size_t i = 0; i < games.size(); ++i)
            drawn.push_back(lists_[i][place(answers_[i].priors, random)]);
    }

    static int place(const std::vector<float>& priors, engine::Random& random) {
        auto left = static_cast<float>(random() >> 40) * 0x1p-24f;
        for (std::size_t i = 0; i + 1 < priors.size(); ++i)
            if ((left -= priors[i]) < 0) return static_cast<int>(i);
        return static_cast<int>(priors.size()) - 1;
    }

    NetworkEvaluator<G> evaluator_;
    std::vector<engine::MoveList> lists_;
    std::vector<Evaluation> answers_;
    std::vector<Query<G>> queries_;
};

}  // namespace search
