// How often AlphaGo's networks are asked, by measurement.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <mutex>

#include "search/relaxed.h"

namespace search {

// Holds networks to a share of the time that workers spend on leaves, by the visits at which a leaf
// is handed to them: n_thr, which Silver et al. 2016 too adapt to how fast their networks answer.
// From any thread.
class CoreShare {
   public:
    using Nanoseconds = std::chrono::nanoseconds;
    static constexpr int first_visits = 15, most_visits = 10'000;

    // `share` of the networks, above 0 and below 1.
    explicit CoreShare(float share) : wanted_(double{share} / (1 - double{share})) {}

    int visits_to_expand() const { return visits_.load(relaxed); }

    void add_rollout(Nanoseconds spent) { add(rollouts_, spent); }
    void add_networks(Nanoseconds spent) { add(networks_, spent); }

   private:
    // Long enough for several answers of a large network.
    static constexpr std::int64_t period = 100'000'000;

    void add(std::atomic<std::int64_t>& to, Nanoseconds spent) {
        to.fetch_add(spent.count(), relaxed);
        if (rollouts_.load(relaxed) + networks_.load(relaxed) >= period) adapt();
    }

    // Nodes with n visits are about as many as 1/n, so the threshold goes with the ratio of the two
    // times; by half of it on the scale of logarithms, as what waits answers late.
    void adapt() {
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (!lock) return;
        const auto rollouts = static_cast<double>(rollouts_.exchange(0, relaxed));
        const auto networks = static_cast<double>(networks_.exchange(0, relaxed));
        if (rollouts + networks < static_cast<double>(period)) return;
        const double ratio = networks / (std::max(rollouts, 1.0) * wanted_);
        exact_ =
            std::clamp(exact_ * std::sqrt(std::clamp(ratio, 0.25, 4.0)), 1.0, double{most_visits});
        visits_.store(static_cast<int>(std::lround(exact_)), relaxed);
    }

    const double wanted_;  // networks' time over rollouts'
    std::atomic<std::int64_t> rollouts_ = 0, networks_ = 0;
    std::atomic<int> visits_ = first_visits;
    std::mutex mutex_;
    double exact_ = first_visits;
};

}  // namespace search
