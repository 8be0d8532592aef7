#include "selfplay/training/pool.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace selfplay::training {

void Pool::add(records::Game game, int side, std::vector<std::uint16_t> turns) {
    assert(!turns.empty());
    auto& shelf = shelves_[side];
    shelf.positions += turns.size();
    positions_ += turns.size();
    shelf.most_turns = std::max(shelf.most_turns, static_cast<int>(turns.size()));
    shelf.entries.push_back({std::move(game), next_number_++, std::move(turns)});
    ++games_;
}

void Pool::drop_oldest() {
    Shelf* oldest = nullptr;
    for (auto& [side, shelf] : shelves_)
        if (!shelf.entries.empty() &&
            (!oldest || shelf.entries.front().number < oldest->entries.front().number))
            oldest = &shelf;
    if (!oldest) return;
    oldest->positions -= oldest->entries.front().turns.size();
    positions_ -= oldest->entries.front().turns.size();
    oldest->entries.pop_front();
    --games_;
}

int Pool::draw_side(engine::Random& random) const {
    assert(positions_ > 0);
    auto left = static_cast<std::size_t>(random.below(static_cast<int>(positions_)));
    for (const auto& [side, shelf] : shelves_) {
        if (left < shelf.positions) return side;
        left -= shelf.positions;
    }
    return shelves_.begin()->first;
}

std::vector<Place> Pool::draw(int side, int count, engine::Random& random) const {
    const auto& shelf = shelves_.at(side);
    std::vector<Place> places;
    places.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) places.push_back(draw_from(shelf, random));
    return places;
}

// Any game, and in it any of as many turns as the longest has; those that it lacks are drawn again.
Place Pool::draw_from(const Shelf& shelf, engine::Random& random) {
    while (true) {
        const auto& entry = shelf.entries[static_cast<std::size_t>(
            random.below(static_cast<int>(shelf.entries.size())))];
        const auto turn = static_cast<std::size_t>(random.below(shelf.most_turns));
        if (turn < entry.turns.size()) return {&entry.game, entry.turns[turn]};
    }
}

const records::Game* Pool::newest() const {
    const Entry* newest = nullptr;
    for (const auto& [side, shelf] : shelves_)
        if (!shelf.entries.empty() && (!newest || shelf.entries.back().number > newest->number))
            newest = &shelf.entries.back();
    return newest ? &newest->game : nullptr;
}

}  // namespace selfplay::training
