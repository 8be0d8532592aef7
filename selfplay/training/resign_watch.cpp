#include "selfplay/training/resign_watch.h"

#include <algorithm>
#include <vector>

namespace selfplay::training {

float lowest_held(const records::Game& game, engine::Player player, int turns) {
    std::vector<float> values;
    for (std::size_t i = player == engine::Player::first ? 0 : 1; i < game.turns.size(); i += 2)
        values.push_back(game.turns[i].value);
    float lowest = 1;
    for (auto last = static_cast<std::size_t>(turns); last <= values.size(); ++last) {
        const auto end = values.begin() + static_cast<std::ptrdiff_t>(last);
        lowest = std::min(lowest, *std::max_element(end - turns, end));
    }
    return lowest;
}

ResignWatch::ResignWatch(float highest, int turns, float errors)
    : highest_(highest), turns_(turns), errors_(errors) {}

void ResignWatch::add(const records::Game& game) {
    const float first = lowest_held(game, engine::Player::first, turns_);
    const float second = lowest_held(game, engine::Player::second, turns_);
    Lows lows;
    if (game.outcome == engine::Outcome::first_wins)
        lows = {second, first};
    else if (game.outcome == engine::Outcome::second_wins)
        lows = {first, second};
    else
        lows = {1, std::min(first, second)};
    games_.push_back(lows);
    if (games_.size() > remembered) games_.pop_front();
    settle();
}

ResignWatch::Count ResignWatch::count(float threshold) const {
    Count count;
    for (const auto& [loser, other] : games_) {
        count.given_up += std::min(loser, other) < threshold;
        count.saved += other < threshold;
    }
    return count;
}

double ResignWatch::error_rate() const {
    const auto [given_up, saved] = count(threshold_);
    return given_up == 0 ? 0 : static_cast<double>(saved) / static_cast<double>(given_up);
}

// The highest of a few thresholds that keeps the errors rare.
void ResignWatch::settle() {
    threshold_ = -1;
    if (games_.size() < enough) return;
    constexpr int steps = 20;
    for (int step = 0; step < steps; ++step) {
        const float candidate =
            highest_ - (highest_ + 1) * static_cast<float>(step) / static_cast<float>(steps);
        const auto [given_up, saved] = count(candidate);
        if (static_cast<float>(saved) > errors_ * static_cast<float>(given_up)) continue;
        threshold_ = candidate;
        return;
    }
}

}  // namespace selfplay::training
