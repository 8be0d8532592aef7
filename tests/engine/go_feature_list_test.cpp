// The features of all moves, as training lists them, are those that the policies play by.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/go/feature_list.h"
#include "engine/go/linear_policy.h"
#include "engine/go/rollouts.h"
#include "engine/go/softmax_policy.h"
#include "tests/engine/go_position.h"

namespace go {
namespace {

std::vector<float> drawn_logits() {
    engine::Random random(4);
    std::vector<float> logits(static_cast<std::size_t>(features::count));
    for (auto& logit : logits) logit = static_cast<float>(2 * uniform(random) - 1);
    return logits;
}

double logit_of(const FeatureList& list, const std::vector<float>& logits, int from, int to) {
    double sum = 0;
    for (int f = from; f < to; ++f)
        sum += static_cast<double>(
            logits[static_cast<std::size_t>(list.features[static_cast<std::size_t>(f)])]);
    return sum;
}

TEST(FeatureList, IsWhatThePoliciesPlayBy) {
    const auto logits = drawn_logits();
    const auto policies =
        std::make_shared<const LinearPolicies>(LinearPolicies{Factors(logits), Factors(logits)});
    const LinearRollouts rollouts(policies);
    engine::Random random(2);
    Go game(7);
    for (int ply = 0; ply < 60 && game.outcome() == Outcome::ongoing; ++ply) {
        FeatureList list;
        list_features(game, list);
        const auto count = list.moves.size();
        std::vector<double> rollout(count), tree(count);
        double rollout_sum = 0, tree_sum = 0;
        MoveList moves;
        for (std::size_t i = 0; i < count; ++i) {
            moves.push(list.moves[i]);
            rollout_sum += rollout[i] =
                std::exp(logit_of(list, logits, list.starts[i], list.rollout_ends[i]));
            tree_sum += tree[i] =
                std::exp(logit_of(list, logits, list.starts[i], list.starts[i + 1]));
        }
        std::vector<float> weights;
        rollouts.weigh(game, moves, weights);
        SoftmaxPolicy<9> policy(policies->rollout, game);
        const auto chances = game.to_play() == Player::first ? policy.chances<Colour::black>()
                                                             : policy.chances<Colour::white>();
        ASSERT_EQ(chances.size(), count);
        for (std::size_t i = 0; i < count; ++i) {
            EXPECT_NEAR(weights[i], std::max(tree[i] / tree_sum, 1e-4), 1e-4);
            const int at = SoftmaxPolicy<9>::Board::index(*game.point_of(list.moves[i]));
            const auto found = std::find_if(chances.begin(), chances.end(),
                                            [&](const auto& one) { return one.first == at; });
            ASSERT_NE(found, chances.end());
            EXPECT_NEAR(found->second, rollout[i] / rollout_sum, 2e-3);
        }
        const auto legal = game.legal_moves();
        game.play(legal[random.below(legal.size())]);
    }
}

}  // namespace
}  // namespace go
