// Games that may be sampled from, and the drawing of positions from them, each with the same
// chance. Games on boards of different sides stand on shelves of their own, since a batch has one
// side. One owner, one thread.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <vector>

#include "engine/base/random.h"
#include "selfplay/records/game.h"

namespace selfplay::training {

// A position of a game in a pool, valid until the pool changes.
struct Place {
    const records::Game* game = nullptr;
    std::size_t turn = 0;
};

class Pool {
   public:
    // `turns`: those that may be drawn, not empty.
    void add(records::Game game, int side, std::vector<std::uint16_t> turns);
    void drop_oldest();

    std::size_t games() const { return games_; }
    std::size_t positions() const { return positions_; }

    // The side of the board of a position drawn from all.
    int draw_side(engine::Random& random) const;
    // With replacement, from the games on boards of that side, of which there must be one.
    std::vector<Place> draw(int side, int count, engine::Random& random) const;
    // The newest game that is whole.
    const records::Game* newest() const;

   private:
    struct Entry {
        records::Game game;
        std::uint64_t number = 0;
        std::vector<std::uint16_t> turns;
    };
    struct Shelf {
        std::deque<Entry> entries;
        std::size_t positions = 0;
        int most_turns = 0;  // that any game here ever had
    };

    static Place draw_from(const Shelf& shelf, engine::Random& random);

    std::map<int, Shelf> shelves_;
    std::size_t games_ = 0, positions_ = 0;
    std::uint64_t next_number_ = 0;
};

}  // namespace selfplay::training
