// A board for rollouts alone, several times as fast as go::Board: the row length is known at
// compile time, a point's neighbours are counted in one word, and the empty points are listed.
// Plays no suicide and knows simple ko only. For rollouts.cpp.
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <utility>

#include "engine/base/random.h"
#include "engine/go/board.h"
#include "engine/go/go.h"

namespace go {

template <int most_size>
class RolloutBoard {
   public:
    explicit RolloutBoard(const Go& game);

    // Plays a uniformly random legal move that fills no own eye and returns its index; or passes,
    // if there is none, and returns 0.
    template <Colour colour>
    int play_random(engine::Random& random);

    static Point point_of(int at) { return {at % stride - 1, at / stride - 1}; }

    // Whose the point is when all that is left are one-point eyes: +1 Black's, -1 White's, 0.
    std::int8_t owner(int x, int y) const;
    // Who first played there since the start of the rollout: likewise.
    std::int8_t first(int x, int y) const { return cell((y + 1) * stride + x + 1).first; }

   private:
    static constexpr int stride = most_size + 1;
    static constexpr int cell_count = (most_size + 2) * stride + 1;

    // Neighbours of each kind in one word: black in bits 0-3, white in 4-7, empty in 8-11. The
    // edge counts as black and as white, so that "all four are mine" needs no other test.
    static constexpr int black_side = 1, white_side = 1 << 4, empty_side = 1 << 8;

    struct alignas(16) Cell {
        std::uint16_t sides = 0;
        std::uint16_t chain = 0;  // head's index; 0, an edge cell, where there is no stone
        std::uint16_t next = 0;
        std::uint16_t slot = 0;        // in empty_
        std::int16_t liberties = 0;    // pseudo-liberties, at heads
        std::uint16_t chain_size = 0;  // at heads
        Colour colour = Colour::edge;
        std::uint8_t at_edge = 0;
        std::int8_t first = 0;  // who first played here
    };

    static constexpr int side_of(Colour colour) {
        return colour == Colour::black ? black_side : white_side;
    }
    // How many of the four neighbours are of the colour, the edge included.
    static constexpr int count(int sides, Colour colour) {
        return (colour == Colour::black ? sides : sides >> 4) & 15;
    }
    static constexpr std::array<int, 4> neighbours(int at) {
        return {at - stride, at - 1, at + 1, at + stride};
    }

    Cell& cell(int at) { return cells_[static_cast<std::size_t>(at)]; }
    const Cell& cell(int at) const { return cells_[static_cast<std::size_t>(at)]; }
    static std::uint16_t word(int n) { return static_cast<std::uint16_t>(n); }

    void place_as_in(const Board& board);
    void count_sides(int at);
    void list_empty(int at);
    void unlist_empty(int at);

    template <Colour colour>
    bool is_eye(int at) const;
    template <Colour colour>
    bool legal_between_stones(int at) const;
    template <Colour colour>
    void play(int at);
    void join(int at, int other);
    template <Colour colour>
    void take(int at);

    std::array<Cell, cell_count> cells_;
    std::array<std::uint16_t, most_size * most_size> empty_;
    int empty_count_ = 0;
    int ko_ = 0;
    int size_;
};

template <int most_size>
RolloutBoard<most_size>::RolloutBoard(const Go& game) : size_(game.size()) {
    assert(size_ <= most_size);
    place_as_in(game.board());
    for (int y = 0; y < size_; ++y)
        for (int x = 0; x < size_; ++x) count_sides((y + 1) * stride + x + 1);
    if (const auto ko = game.ko_point()) ko_ = (ko->y + 1) * stride + ko->x + 1;
}

template <int most_size>
void RolloutBoard<most_size>::place_as_in(const Board& board) {
    // From the index there to the index here.
    const auto translate = [&](int at) { return board.y(at) * stride + stride + board.x(at) + 1; };
    for (int y = 0; y < size_; ++y) {
        int here = (y + 1) * stride + 1;
        for (int there = board.index(0, y), end = there + size_; there < end; ++there, ++here) {
            Cell& point = cell(here);
            point.colour = board.at(there);
            if (point.colour == Colour::empty) {
                list_empty(here);
                continue;
            }
            point.chain = word(translate(board.head(there)));
            point.next = word(translate(board.next(there)));
        }
    }
}

// Fills in what depends on the neighbours, their colours being in place.
template <int most_size>
void RolloutBoard<most_size>::count_sides(int at) {
    Cell& point = cell(at);
    int sides = 0;
    for (const int beside : neighbours(at)) {
        const auto colour = cell(beside).colour;
        if (colour == Colour::edge) point.at_edge = 1;
        sides += colour == Colour::empty  ? empty_side
                 : colour == Colour::edge ? black_side + white_side
                                          : side_of(colour);
    }
    point.sides = word(sides);
    if (point.colour == Colour::empty) return;
    Cell& head = cell(point.chain);
    head.liberties = static_cast<std::int16_t>(head.liberties + (sides >> 8));
    ++head.chain_size;
}

template <int most_size>
void RolloutBoard<most_size>::list_empty(int at) {
    cell(at).slot = word(empty_count_);
    empty_[static_cast<std::size_t>(empty_count_++)] = word(at);
}

template <int most_size>
void RolloutBoard<most_size>::unlist_empty(int at) {
    const auto last = empty_[static_cast<std::size_t>(--empty_count_)];
    empty_[cell(at).slot] = last;
    cell(last).slot = cell(at).slot;
}

template <int most_size>
template <Colour colour>
bool RolloutBoard<most_size>::is_eye(int at) const {
    if (count(cell(at).sides, colour) != 4) return false;
    constexpr auto enemy = opponent(colour);
    int enemies = cell(at).at_edge;
    for (const int corner : {at - stride - 1, at - stride + 1, at + stride - 1, at + stride + 1})
        enemies += cell(corner).colour == enemy;
    return enemies < 2;
}

// Of a point without an empty neighbour: does the stone take, or join a chain with another liberty?
template <int most_size>
template <Colour colour>
bool RolloutBoard<most_size>::legal_between_stones(int at) const {
    if (at == ko_) return false;
    const auto beside = neighbours(at);
    for (const int one : beside) {
        if (cell(one).colour == Colour::edge) continue;
        const int chain = cell(one).chain;
        int sides = 0;
        for (const int other : beside) sides += cell(other).chain == chain;
        const bool lives = cell(chain).liberties > sides;
        if (lives == (cell(one).colour == colour)) return true;
    }
    return false;
}

template <int most_size>
void RolloutBoard<most_size>::join(int at, int other) {
    int head = cell(at).chain;
    if (head == other) return;
    if (cell(head).chain_size < cell(other).chain_size) std::swap(head, other);
    int stone = other;
    do {
        cell(stone).chain = word(head);
        stone = cell(stone).next;
    } while (stone != other);
    std::swap(cell(head).next, cell(other).next);
    cell(head).liberties = static_cast<std::int16_t>(cell(head).liberties + cell(other).liberties);
    cell(head).chain_size = word(cell(head).chain_size + cell(other).chain_size);
}

template <int most_size>
template <Colour colour>
void RolloutBoard<most_size>::take(int at) {
    int stone = at;
    do {
        Cell& gone = cell(stone);
        const int next = gone.next;
        gone.colour = Colour::empty;
        gone.chain = 0;
        for (const int beside : neighbours(stone)) {
            cell(beside).sides = word(cell(beside).sides + empty_side - side_of(colour));
            ++cell(cell(beside).chain).liberties;
        }
        list_empty(stone);
        stone = next;
    } while (stone != at);
}

template <int most_size>
template <Colour colour>
void RolloutBoard<most_size>::play(int at) {
    constexpr auto enemy = opponent(colour);
    Cell& stone = cell(at);
    const bool in_enemy_eye = count(stone.sides, enemy) == 4;
    unlist_empty(at);
    stone.colour = colour;
    if (stone.first == 0) stone.first = colour == Colour::black ? 1 : -1;
    stone.chain = stone.next = word(at);
    stone.chain_size = 1;
    stone.liberties = static_cast<std::int16_t>(stone.sides >> 8);
    const auto around = neighbours(at);
    for (const int beside : around) {
        cell(beside).sides = word(cell(beside).sides + side_of(colour) - empty_side);
        // Chain 0 is nobody's: cheaper to count there than to ask whether there is a stone.
        --cell(cell(beside).chain).liberties;
    }
    for (const int beside : around)
        if (cell(beside).colour == colour) join(at, cell(beside).chain);
    const int before = empty_count_;
    for (const int beside : around)
        if (cell(beside).colour == enemy && cell(cell(beside).chain).liberties == 0)
            take<enemy>(beside);
    const bool takes_ko = in_enemy_eye && empty_count_ == before + 1;
    ko_ = takes_ko ? empty_[static_cast<std::size_t>(before)] : 0;
}

template <int most_size>
template <Colour colour>
int RolloutBoard<most_size>::play_random(engine::Random& random) {
    // Points found unfit go behind the rest, out of the draw.
    for (int left = empty_count_; left > 0;) {
        auto& drawn = empty_[static_cast<std::size_t>(random.below(left))];
        const int at = drawn;
        const bool open = cell(at).sides >= empty_side;
        if (open || (!is_eye<colour>(at) && legal_between_stones<colour>(at))) {
            play<colour>(at);
            return at;
        }
        auto& last = empty_[static_cast<std::size_t>(--left)];
        std::swap(cell(drawn).slot, cell(last).slot);
        std::swap(drawn, last);
    }
    ko_ = 0;
    return 0;
}

template <int most_size>
std::int8_t RolloutBoard<most_size>::owner(int x, int y) const {
    const Cell& point = cell((y + 1) * stride + x + 1);
    if (point.colour == Colour::black) return 1;
    if (point.colour == Colour::white) return -1;
    return static_cast<std::int8_t>((count(point.sides, Colour::black) == 4) -
                                    (count(point.sides, Colour::white) == 4));
}

}  // namespace go
