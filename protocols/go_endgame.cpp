#include "protocols/go_endgame.h"

#include <algorithm>
#include <cmath>

namespace protocols {

namespace {

using engine::Player;
using go::Point;

// Mean owner of a chain below which it is dead, above which it lives; between lies seki.
constexpr float dead_below = -0.4f, alive_above = 0.4f;
// A point is decided when all but one game in twenty agree.
constexpr float decided = 0.9f;

std::size_t index_of(const go::Go& game, Point point) {
    const int index = point.y * game.size() + point.x;
    return static_cast<std::size_t>(index);
}

Point point_at(const go::Go& game, std::size_t index) {
    const auto size = static_cast<std::size_t>(game.size());
    return {static_cast<int>(index % size), static_cast<int>(index / size)};
}

std::vector<Point> neighbours(const go::Go& game, Point point) {
    std::vector<Point> found;
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        const Point n{point.x + dx, point.y + dy};
        if (n.x >= 0 && n.y >= 0 && n.x < game.size() && n.y < game.size()) found.push_back(n);
    }
    return found;
}

std::vector<Point> chain_of(const go::Go& game, Point start) {
    std::vector<Point> chain{start};
    for (std::size_t i = 0; i < chain.size(); ++i)
        for (const Point n : neighbours(game, chain[i]))
            if (game.at(n) == game.at(start) &&
                std::find(chain.begin(), chain.end(), n) == chain.end())
                chain.push_back(n);
    return chain;
}

float sign_of(Player player) { return player == Player::first ? 1.0f : -1.0f; }

std::vector<float> chain_owners(const go::Go& game, const std::vector<float>& owners) {
    std::vector<float> means(owners.size(), 2);
    for (std::size_t i = 0; i < owners.size(); ++i) {
        const Point start = point_at(game, i);
        if (!game.at(start) || means[i] < 2) continue;
        const auto chain = chain_of(game, start);
        float sum = 0;
        for (const Point p : chain) sum += owners[index_of(game, p)] * sign_of(*game.at(start));
        for (const Point p : chain)
            means[index_of(game, p)] = sum / static_cast<float>(chain.size());
    }
    return means;
}

// Whether the final score gives every point to whom the games played out gave it.
bool beyond_doubt(const std::vector<float>& owners, const go::Score& score) {
    for (std::size_t i = 0; i < owners.size(); ++i) {
        const float expected = score.owners[i] ? sign_of(*score.owners[i]) : 0;
        if (expected * owners[i] < decided) return false;
    }
    return true;
}

}  // namespace

bool agrees_on_dead_stones(const go::Rules& rules) {
    return rules.friendly_pass || rules.scoring == go::Scoring::territory;
}

Reading::Reading(const go::Go& game, const std::vector<float>& owners)
    : game_(game), chain_owner_(chain_owners(game, owners)) {
    if (agrees_on_dead_stones(game.rules())) dead_ = stones(go::Status::dead);
    score_ = go::score(game, dead_);
    settled_ = beyond_doubt(owners, score_);
}

go::Status Reading::status(Point point) const {
    const float owner = chain_owner_[index_of(game_, point)];
    if (owner < dead_below) return go::Status::dead;
    return owner > alive_above ? go::Status::alive : go::Status::seki;
}

std::vector<Point> Reading::stones(go::Status wanted) const {
    std::vector<Point> found;
    for (std::size_t i = 0; i < chain_owner_.size(); ++i) {
        const Point point = point_at(game_, i);
        if (game_.at(point) && status(point) == wanted) found.push_back(point);
    }
    return found;
}

std::vector<Point> liberties_of(const go::Go& game, const std::vector<Point>& stones,
                                Player owner) {
    std::vector<Point> found;
    for (const Point stone : stones) {
        if (game.at(stone) != owner) continue;
        for (const Point n : neighbours(game, stone))
            if (!game.at(n) && std::find(found.begin(), found.end(), n) == found.end())
                found.push_back(n);
    }
    return found;
}

bool should_pass(const go::Go& game, const Reading& reading) {
    const auto won = [&](const go::Score& score) {
        return engine::value_for(game.to_play(), score.outcome()) > 0;
    };
    // The opponent gives the last word to us: take it when the board wins as it stands, whoever
    // counts it.
    if (game.consecutive_passes() > 0 && won(go::score(game)) && won(reading.score())) return true;
    // Both are needed: what other referees count who know nothing of dead stones is their affair,
    // but a settled board that we lose is no reason to fill it up.
    if (!reading.settled()) return false;
    return agrees_on_dead_stones(game.rules()) || won(reading.score());
}

}  // namespace protocols
