#include "search/leaf.h"

#include <algorithm>
#include <cassert>

namespace search {

namespace {

constexpr auto relaxed = std::memory_order_relaxed;

// With a single writer a plain load and store do, and cost nothing.
template <class T>
void increase(std::atomic<T>& sum, T amount) {
    sum.store(sum.load(relaxed) + amount, relaxed);
}

}  // namespace

void OwnerTally::add(const engine::RolloutResult& result) {
    assert(result.owners.size() <= most_points);
    increase(rollouts_, std::int64_t{1});
    increase(draws_, std::int64_t{result.outcome == engine::Outcome::draw});
    increase(lead_, static_cast<double>(result.lead));
    points_.store(result.owners.size(), relaxed);
    for (std::size_t i = 0; i < result.owners.size(); ++i)
        increase(owners_[i], std::int32_t{result.owners[i]});
}

void OwnerTally::reset() {
    rollouts_ = draws_ = 0;
    lead_ = 0;
    points_ = 0;
    for (auto& owner : owners_) owner.store(0, relaxed);
}

void OwnerTally::add_to(Sum& sum) const {
    sum.rollouts += rollouts_.load(relaxed);
    sum.draws += draws_.load(relaxed);
    sum.lead += lead_.load(relaxed);
    const auto points = points_.load(relaxed);
    sum.owners.resize(std::max(sum.owners.size(), points));
    for (std::size_t i = 0; i < points; ++i) sum.owners[i] += owners_[i].load(relaxed);
}

}  // namespace search
