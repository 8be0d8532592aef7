#include "search/mate_table.h"

#include <algorithm>
#include <bit>

namespace search {

MateTable::MateTable(std::size_t bytes)
    : entries_(std::bit_floor(std::max(bytes / sizeof(Entry), bucket))) {}

std::size_t MateTable::begin_of(std::uint64_t key) const {
    return key & (entries_.size() - 1) & ~(bucket - 1);
}

const MateTable::Entry* MateTable::find(std::uint64_t key) const {
    const auto begin = begin_of(key);
    for (std::size_t i = begin; i < begin + bucket; ++i)
        if (entries_[i].key == key) return &entries_[i];
    return nullptr;
}

MateTable::Entry& MateTable::at(std::uint64_t key) {
    const auto begin = begin_of(key);
    Entry* least = &entries_[begin];
    for (std::size_t i = begin; i < begin + bucket; ++i) {
        if (entries_[i].key == key) return entries_[i];
        if (entries_[i].work < least->work) least = &entries_[i];
    }
    *least = Entry{};
    least->key = key;
    return *least;
}

}  // namespace search
