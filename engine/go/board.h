// Stones on a board of 2x2 to 25x25: who stands where, chains, captures. It knows no history, no
// ko and no rule that can differ; a plain value of under 4 KB. For this folder; others ask Go.
//
// Points are indices into a grid with an edge around it: index(x, y), 0 is no point. Each chain is
// a ring through `next`; its head counts pseudo-liberties: every empty neighbour of every stone, a
// point shared by k stones counting k times. None are left exactly when no liberty is left.
#pragma once

#include <algorithm>
#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>

#include "engine/game.h"

namespace go {

inline constexpr int min_size = 2, max_size = 25;
inline constexpr int most_points = max_size * max_size;

// The order of points that arrays outside the board use: y * size + x.
using PointSet = std::bitset<most_points>;

enum class Colour : std::uint8_t { empty, black, white, edge };

constexpr Colour colour_of(engine::Player player) {
    return player == engine::Player::first ? Colour::black : Colour::white;
}
// Of black and white only.
constexpr engine::Player player_of(Colour colour) {
    return colour == Colour::black ? engine::Player::first : engine::Player::second;
}
constexpr Colour opponent(Colour colour) {
    return colour == Colour::black ? Colour::white : Colour::black;
}

// The stones of each player, Black's first.
using Stones = std::array<PointSet, 2>;

class Board {
   public:
    explicit Board(int size);
    // With these stones, none of them without liberty.
    Board(int size, const Stones& stones);
    // Copies what boards of this size use.
    Board(const Board& other) { *this = other; }
    Board& operator=(const Board& other) {
        size_ = other.size_;
        key_ = other.key_;
        stones_ = other.stones_;
        std::copy_n(other.cells_.begin(), used_cells(), cells_.begin());
        return *this;
    }

    // The same stones; how their chains came about does not count.
    bool operator==(const Board& other) const {
        return size_ == other.size_ && stones_ == other.stones_;
    }

    int size() const { return size_; }
    int stride() const { return size_ + 1; }
    int index(int x, int y) const { return (y + 1) * stride() + x + 1; }
    int x(int at) const { return at % stride() - 1; }
    int y(int at) const { return at / stride() - 1; }
    std::size_t order(int at) const { return static_cast<std::size_t>(y(at) * size_ + x(at)); }
    bool holds(int at) const;  // is `at` the index of a point of this board

    Colour at(int at) const { return cell(at).colour(); }
    const Stones& stones() const { return stones_; }
    // Zobrist key of the stones alone.
    std::uint64_t key() const { return key_; }

    std::array<int, 4> neighbours(int at) const {
        return {at - stride(), at - 1, at + 1, at + stride()};
    }
    std::array<int, 4> diagonals(int at) const {
        return {at - stride() - 1, at - stride() + 1, at + stride() - 1, at + stride() + 1};
    }

    bool is_lone_stone(int at) const { return cell(at).next() == at; }
    int head(int at) const { return cell(at).head(); }
    int next(int at) const { return cell(at).next(); }  // stone of the chain
    // Calls action(index) on every stone of the chain at `at`; the action must not change the
    // board.
    template <class Action>
    void for_each_stone(int at, Action action) const {
        int stone = at;
        do {
            action(stone);
            stone = cell(stone).next();
        } while (stone != at);
    }
    template <class Action>
    void for_each_point(Action action) const {
        for (int y = 0; y < size_; ++y)
            for (int x = 0, at = index(0, y); x < size_; ++x, ++at) action(at);
    }
    bool has_liberty(int at) const { return cell(head(at)).liberties() != 0; }
    // Distinct liberties of the chain at `at`, counted up to `most`.
    int liberties(int at, int most = most_points) const;

    // What a stone of `colour` on the empty point `at` would do.
    bool captures(int at, Colour colour) const;
    bool is_suicide(int at, Colour colour) const;
    std::uint64_t key_after(int at, Colour colour) const;

    struct Taken {
        int enemy = 0, own = 0;
        int last = 0;  // one of the points emptied, 0 if none
    };
    // Puts a stone on an empty point and takes off the chains that it leaves without liberty: the
    // enemy's, else its own.
    Taken play(int at, Colour colour);
    // Puts a stone on, or takes it off (Colour::empty), capturing nothing.
    void set_up(int at, Colour colour);

   private:
    // All about one point in a word: 2 bits of colour, then 10 each of its chain's head, of the
    // next stone and, at a head, of pseudo-liberties. Ten do: s stones in one chain touch at most
    // min(2s + 2, 4 (625 - s)) <= 834 empty sides.
    class Cell {
       public:
        Cell() = default;
        constexpr explicit Cell(Colour colour, int at = 0)
            : bits_(static_cast<std::uint32_t>(colour) | word(at) << 2 | word(at) << 12) {}
        Colour colour() const { return static_cast<Colour>(bits_ & 3); }
        int head() const { return static_cast<int>(bits_ >> 2 & 1023); }
        int next() const { return static_cast<int>(bits_ >> 12 & 1023); }
        int liberties() const { return static_cast<int>(bits_ >> 22); }
        void set_head(int at) { bits_ = (bits_ & ~(1023u << 2)) | word(at) << 2; }
        void set_next(int at) { bits_ = (bits_ & ~(1023u << 12)) | word(at) << 12; }
        void add_liberties(int count) { bits_ += word(count) << 22; }

       private:
        static constexpr std::uint32_t word(int n) { return static_cast<std::uint32_t>(n); }
        std::uint32_t bits_;
    };

    std::size_t used_cells() const { return static_cast<std::size_t>((size_ + 2) * stride() + 1); }
    static bool is_stone(Colour colour) {
        return colour == Colour::black || colour == Colour::white;
    }
    const Cell& cell(int at) const { return cells_[static_cast<std::size_t>(at)]; }
    Cell& cell(int at) { return cells_[static_cast<std::size_t>(at)]; }
    // Is `at` the last liberty of the chain of its neighbour `beside`?
    bool fills_last_liberty(int at, int beside) const;
    template <class Seen>
    int distinct_liberties(int at, int most) const;
    std::uint64_t chain_key(int at) const;
    void put(int at, Colour colour);
    void join(int a, int b);
    int take_chain(int at);
    void add_liberty_beside(int at, int count);

    static constexpr std::size_t most_cells = (max_size + 2) * (max_size + 1) + 1;
    std::array<Cell, most_cells> cells_;
    Stones stones_;
    std::uint64_t key_ = 0;
    int size_;
};

}  // namespace go
