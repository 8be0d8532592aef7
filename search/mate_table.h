// What a mate search knows of positions, in a bounded table; for search/mate.h alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/game.h"

namespace search {

class MateTable {
   public:
    // Two numbers a key, whose meaning is the search's: proof numbers, or depths.
    struct Entry {
        std::uint64_t key = 0;
        std::uint32_t first = 0, second = 0;
        std::uint32_t work = 0;  // what finding it out again would cost; the least gives way
        engine::Move move{};
    };

    // At most `bytes`, at least one entry's bucket.
    explicit MateTable(std::size_t bytes);

    // Null when nothing is known.
    const Entry* find(std::uint64_t key) const;
    // The entry of `key`, old or fresh, if need be in the place of another.
    Entry& at(std::uint64_t key);

   private:
    static constexpr std::size_t bucket = 4;
    std::size_t begin_of(std::uint64_t key) const;

    std::vector<Entry> entries_;
};

}  // namespace search
