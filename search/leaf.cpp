#include "search/leaf.h"

#include <algorithm>
#include <cassert>

#include "search/relaxed.h"

namespace search {

namespace {

// With a single writer a plain load and store do, and cost nothing.
template <class T>
void increase(std::atomic<T>& sum, T amount) {
    sum.store(sum.load(relaxed) + amount, relaxed);
}

}  // namespace

void OwnerTally::add(const engine::RolloutResult& result) {
    assert(result.owners.size() <= most_points);
    increase(rollouts_, std::int64_t{1});
    increase(lead_, static_cast<double>(result.lead));
    points_.store(result.owners.size(), relaxed);
    for (std::size_t i = 0; i < result.owners.size(); ++i)
        increase(owners_[i], unit * result.owners[i]);
}

void OwnerTally::add(std::span<const float> owners, float lead, float sign) {
    assert(owners.size() <= most_points);
    increase(rollouts_, std::int64_t{1});
    increase(lead_, static_cast<double>(sign * lead));
    points_.store(owners.size(), relaxed);
    const float scale = sign * static_cast<float>(unit);
    for (std::size_t i = 0; i < owners.size(); ++i)
        increase(owners_[i], static_cast<std::int64_t>(scale * owners[i]));
}

void OwnerTally::add_length(float plies) {
    increase(lengths_, std::int64_t{1});
    increase(plies_, static_cast<double>(plies));
}

void OwnerTally::reset() {
    rollouts_ = lengths_ = 0;
    lead_ = plies_ = 0;
    points_ = 0;
    for (auto& owner : owners_) owner.store(0, relaxed);
}

void OwnerTally::add_to(Sum& sum) const {
    sum.rollouts += rollouts_.load(relaxed);
    sum.lengths += lengths_.load(relaxed);
    sum.lead += lead_.load(relaxed);
    sum.plies += plies_.load(relaxed);
    const auto points = points_.load(relaxed);
    sum.owners.resize(std::max(sum.owners.size(), points));
    for (std::size_t i = 0; i < points; ++i)
        sum.owners[i] += static_cast<double>(owners_[i].load(relaxed)) / double{unit};
}

}  // namespace search
