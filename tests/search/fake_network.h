// Evaluators that tests are sure of: a stand-in on tic-tac-toe that writes down what it is asked,
// and small networks with random weights for every game.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/encoding.h"
#include "nn/builders.h"
#include "search/evaluator.h"
#include "tests/search/tictactoe.h"

namespace fake {

using tictactoe::TicTacToe;

// Equal priors; wins by a tenth of the symmetry's number; or what `answer` makes of it.
class Network final : public search::Evaluator<TicTacToe> {
   public:
    int asked = 0;
    int symmetric = 1;
    std::vector<int> seen;                        // symmetries, in the order of the questions
    std::vector<std::size_t>* batches = nullptr;  // gets how many were asked about at once
    std::function<void(const search::Query<TicTacToe>&)> answer;

    void evaluate(std::span<const search::Query<TicTacToe>> queries) override {
        if (batches) batches->push_back(queries.size());
        for (const auto& query : queries) {
            ++asked;
            seen.push_back(query.symmetry);
            auto& to = *query.answer;
            to = {};
            const auto count = static_cast<std::size_t>(query.moves->size());
            to.priors.assign(count, 1 / static_cast<float>(count));
            to.win = static_cast<float>(query.symmetry) / 10;
            to.loss = 1 - to.win;
            if (answer) answer(query);
        }
    }
    int symmetries(const TicTacToe&) const override { return symmetric; }
    std::uint64_t key(const TicTacToe& game) const override { return game.key() + 1; }
};

template <engine::Encoded G>
nn::Graph small_network(int blocks = 1, int channels = 8) {
    const G game;
    const auto& encoding = G::encodings()[0];
    const auto shape = encoding.shape(game);
    nn::TowerDescription tower;
    tower.facts = {.game = std::string(G::name),
                   .encoding = std::string(encoding.name),
                   .name = "random",
                   .source = {},
                   .licence = {},
                   .board = shape.height,
                   .blocks = blocks,
                   .channels = channels};
    tower.planes = shape.planes;
    tower.globals = shape.globals;
    tower.value_width = 16;
    tower.wdl = true;
    if (shape.symmetries > 1) {
        tower.facts.board = 0;
        tower.policy = nn::PolicyHead::points;
        tower.flat_value = false;
    } else {
        tower.policy = nn::PolicyHead::planes;
        tower.move_planes = shape.policy_size / static_cast<int>(shape.points());
    }
    engine::Random random(1);
    return nn::build_tower(tower, random);
}

}  // namespace fake
