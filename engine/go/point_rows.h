// Sets of points of one board, a word a row: what a whole set is beside, and what is joined to it,
// takes a few instructions a row.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "engine/go/board.h"

namespace go {

class PointRows {
   public:
    explicit PointRows(int size) : size_(static_cast<std::size_t>(size)) {}
    // Where the board has this colour; not of its edge.
    PointRows(const Board& board, Colour colour) : PointRows(board.size()) {
        for (std::size_t y = 0; y < size_; ++y) {
            const int row = board.index(0, static_cast<int>(y));
            for (int x = 0; x < board.size(); ++x)
                rows_[y] |= Row{board.at(row + x) == colour} << x;
        }
    }

    void set(int x, int y) { rows_[static_cast<std::size_t>(y)] |= Row{1} << x; }

    PointRows& operator|=(const PointRows& other) {
        for (std::size_t y = 0; y < size_; ++y) rows_[y] |= other.rows_[y];
        return *this;
    }
    PointRows& operator&=(const PointRows& other) {
        for (std::size_t y = 0; y < size_; ++y) rows_[y] &= other.rows_[y];
        return *this;
    }
    PointRows& operator-=(const PointRows& other) {
        for (std::size_t y = 0; y < size_; ++y) rows_[y] &= ~other.rows_[y];
        return *this;
    }
    PointRows operator|(const PointRows& other) const { return PointRows(*this) |= other; }
    PointRows operator&(const PointRows& other) const { return PointRows(*this) &= other; }
    PointRows operator-(const PointRows& other) const { return PointRows(*this) -= other; }

    bool any() const {
        Row all = 0;
        for (std::size_t y = 0; y < size_; ++y) all |= rows_[y];
        return all != 0;
    }
    int count() const {
        int points = 0;
        for (std::size_t y = 0; y < size_; ++y) points += std::popcount(rows_[y]);
        return points;
    }

    // One of these points alone; there must be one.
    PointRows one() const {
        PointRows point(static_cast<int>(size_));
        std::size_t y = 0;
        while (rows_[y] == 0) ++y;
        point.rows_[y] = rows_[y] & -rows_[y];
        return point;
    }

    // The points beside one of these, which may be of these too.
    PointRows beside() const {
        const Row board = (Row{1} << size_) - 1;
        PointRows result(static_cast<int>(size_));
        for (std::size_t y = 0; y < size_; ++y) {
            Row row = rows_[y] << 1 | rows_[y] >> 1;
            if (y > 0) row |= rows_[y - 1];
            if (y + 1 < size_) row |= rows_[y + 1];
            result.rows_[y] = row & board;
        }
        return result;
    }

    // The points of `within` that neighbours in it join to these, which are of it themselves.
    PointRows joined(const PointRows& within) const {
        PointRows result = *this;
        while (result.spread_down(within) || result.spread_up(within)) {
        }
        return result;
    }

    // Calls action(x, y) on every point, row by row.
    template <class Action>
    void for_each(Action action) const {
        for (std::size_t y = 0; y < size_; ++y)
            for (Row row = rows_[y]; row != 0; row &= row - 1)
                action(std::countr_zero(row), static_cast<int>(y));
    }

   private:
    using Row = std::uint32_t;

    // All runs of `within` that hold a point of `row`.
    static Row spread(Row row, Row within) {
        Row right = row & within, left = right, right_of = within, left_of = within;
        for (int by = 1; by < max_size; by *= 2) {
            right |= right_of & right << by;
            right_of &= right_of << by;
            left |= left_of & left >> by;
            left_of &= left_of >> by;
        }
        return right | left;
    }
    bool take(std::size_t y, Row row, Row within) {
        if ((row & within & ~rows_[y]) == 0) return false;
        rows_[y] = spread(rows_[y] | row, within);
        return true;
    }
    bool spread_down(const PointRows& within) {
        bool grew = false;
        for (std::size_t y = 0; y < size_; ++y)
            grew |= take(y, rows_[y] << 1 | rows_[y] >> 1 | (y > 0 ? rows_[y - 1] : 0),
                         within.rows_[y]);
        return grew;
    }
    bool spread_up(const PointRows& within) {
        bool grew = false;
        for (std::size_t y = size_ - 1; y-- > 0;) grew |= take(y, rows_[y + 1], within.rows_[y]);
        return grew;
    }

    std::size_t size_;
    std::array<Row, max_size> rows_{};
};

}  // namespace go
