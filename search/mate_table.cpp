#include "search/mate_table.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace search {

namespace {

// To twice the size and within the reserve, so that nothing is copied elsewhere: an entry stays
// where it is, or goes to the same place in the new half.
void grow(std::vector<MateTable::Entry>& entries) {
    const auto half = entries.size();
    entries.resize(2 * half);
    for (std::size_t i = 0; i < half; ++i)
        if (entries[i].key & half) std::swap(entries[i], entries[half + i]);
}

}  // namespace

// Clearing all of a table would take longer than most mates, so it begins small.
MateTable::MateTable(std::size_t bytes) {
    constexpr std::size_t first_size = 4096;
    const auto most = std::bit_floor(std::max(bytes / sizeof(Entry), bucket));
    entries_.reserve(most);
    entries_.resize(std::min(most, first_size));
}

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
    if (least->key != 0 && 2 * entries_.size() <= entries_.capacity()) {
        grow(entries_);
        return at(key);
    }
    *least = Entry{};
    least->key = key;
    return *least;
}

}  // namespace search
