// What the liberties of a chain add up to, kept as stones come and go: empty sides, a liberty
// counted once for each stone beside it. For rollout boards.
#pragma once

#include <cstdint>

namespace go {

// What a chain's liberties add up to. One word holds for the empty sides of all its stones their
// number, the sum of their points and that of the points' squares; in atari, and only there,
// number times squares is the sum squared.
class LibertySum {
   public:
    constexpr LibertySum() = default;
    explicit constexpr LibertySum(int at) : bits_(1 | number(at) << 11 | number(at * at) << 31) {}

    LibertySum& operator+=(LibertySum other) { return bits_ += other.bits_, *this; }
    LibertySum& operator-=(LibertySum other) { return bits_ -= other.bits_, *this; }

    bool none() const { return bits_ == 0; }
    bool only_one() const { return bits_ != 0 && count() * (bits_ >> 31) == points() * points(); }
    int the_one() const { return static_cast<int>(points() / count()); }

   private:
    static constexpr std::uint64_t number(int n) { return static_cast<std::uint64_t>(n); }
    std::uint64_t count() const { return bits_ & 0x7ff; }
    std::uint64_t points() const { return bits_ >> 11 & 0xfffff; }

    std::uint64_t bits_ = 0;
};

// The same without knowing where.
class LibertyCount {
   public:
    constexpr LibertyCount() = default;
    explicit constexpr LibertyCount(int count) : count_(word(count)) {}

    LibertyCount& operator+=(LibertyCount other) {
        return count_ = word(count_ + other.count_), *this;
    }
    LibertyCount& operator-=(LibertyCount other) {
        return count_ = word(count_ - other.count_), *this;
    }

    bool none() const { return count_ == 0; }

   private:
    static constexpr std::int16_t word(int n) { return static_cast<std::int16_t>(n); }

    std::int16_t count_ = 0;
};

}  // namespace go
