#include "search/prior_sorter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "engine/base/random.h"

namespace search {
namespace {

// As many as chess has, as shogi may have, as Go has on 19x19.
TEST(PriorSorter, HighestFirstEqualsAsTheyWere) {
    engine::Random random(1);
    PriorSorter sorter;
    for (const int count : {0, 1, 2, 30, 48, 49, 120, 362}) {
        std::vector<float> priors;
        engine::MoveList moves;
        for (int i = 0; i < count; ++i) {
            // Few values, so that many are equal.
            priors.push_back(static_cast<float>(random.below(20)) / 40);
            moves.push({static_cast<std::uint16_t>(count - i)});
        }
        std::vector<int> order(priors.size());
        std::iota(order.begin(), order.end(), 0);
        std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
            return priors[static_cast<std::size_t>(a)] > priors[static_cast<std::size_t>(b)];
        });
        auto sorted = priors;
        auto sorted_moves = moves;
        sorter.sort(sorted, sorted_moves);
        ASSERT_EQ(sorted.size(), priors.size());
        ASSERT_EQ(sorted_moves.size(), count);
        for (int i = 0; i < count; ++i) {
            const auto at = static_cast<std::size_t>(i);
            EXPECT_EQ(sorted_moves[i], moves[order[at]]) << count;
            const auto prior = priors[static_cast<std::size_t>(order[at])];
            EXPECT_EQ(sorted[at], unpack_prior(pack_prior(prior)));
        }
    }
}

}  // namespace
}  // namespace search
