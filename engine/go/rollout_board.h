// A board for rollouts alone, several times as fast as go::Board: the row length is known at
// compile time, a point's neighbours are counted in one word, and the empty points are listed.
// Plays no suicide and knows simple ko only. A tactical one also knows, at any time and for little
// more, which chains are in atari and where, and the colours around a point: for rollouts by
// policy. For this folder.
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "engine/base/random.h"
#include "engine/go/board.h"
#include "engine/go/go.h"
#include "engine/go/liberty_sums.h"

namespace go {

template <int most_size, bool tactical = false>
class RolloutBoard {
   public:
    static constexpr int stride = most_size + 1;
    static constexpr int cell_count = (most_size + 2) * stride + 1;

    explicit RolloutBoard(const Go& game);

    // Plays a uniformly random legal move that fills no own eye and returns its index; or passes,
    // if there is none, and returns 0.
    template <Colour colour>
    int play_random(engine::Random& random) {
        return play_random<colour>(random, [](int) { return true; });
    }
    // Likewise among those that `accept` is true of.
    template <Colour colour, class Accept>
    int play_random(engine::Random& random, Accept accept);
    // A legal move. Returns how many stones it takes: newly_empty(0) and so on until another move.
    template <Colour colour>
    int play(int at);
    void pass() { ko_ = 0; }
    int newly_empty(int i) const { return empty_[static_cast<std::size_t>(empty_count_ - 1 - i)]; }

    static Point point_of(int at) { return {at % stride - 1, at / stride - 1}; }
    static int index(Point point) { return (point.y + 1) * stride + point.x + 1; }
    static constexpr std::array<int, 4> neighbours(int at) {
        return {at - stride, at - 1, at + 1, at + stride};
    }
    // visit(neighbour) for each of the four, unrolled, which of a loop over them is not certain.
    template <class Visit>
    static void for_neighbours(int at, Visit visit) {
        visit(at - stride);
        visit(at - 1);
        visit(at + 1);
        visit(at + stride);
    }
    // In the order of RolloutBoard::surroundings.
    static constexpr std::array<int, 8> around(int at) {
        return {at - stride - 1, at - stride,     at - stride + 1, at - 1,
                at + 1,          at + stride - 1, at + stride,     at + stride + 1};
    }

    int size() const { return size_; }
    int ko() const { return ko_; }  // the index that it forbids, or 0
    Colour at(int at) const { return cell(at).colour; }
    template <Colour colour>
    bool is_legal(int at) const {
        return cell(at).sides >= empty_side ? at != ko_ : legal_between_stones<colour>(at);
    }
    template <Colour colour>
    bool is_eye(int at) const;
    int empty_neighbours(int at) const { return cell(at).sides >> 8; }

    // Of the chain at `at`.
    int head(int at) const { return cell(at).chain; }
    int next(int at) const { return cell(at).next; }
    int chain_size(int at) const { return cell(head(at)).chain_size; }
    // Tactical boards only.
    bool in_atari(int at) const { return cell(head(at)).liberties.only_one(); }
    int last_liberty(int at) const { return cell(head(at)).liberties.the_one(); }
    LibertySum liberties(int at) const { return cell(head(at)).liberties; }
    // Colours of the eight points around, two bits each, the lowest first in the order of around().
    std::uint16_t surroundings(int at) const { return cell(at).surroundings; }

    // Whose the point is when all that is left are one-point eyes: +1 Black's, -1 White's, 0.
    std::int8_t owner(int x, int y) const;
    // Who first played there since the start of the rollout: likewise.
    std::int8_t first(int x, int y) const { return cell((y + 1) * stride + x + 1).first; }

   private:
    // Neighbours of each kind in one word: black in bits 0-3, white in 4-7, empty in 8-11. The
    // edge counts as black and as white, so that "all four are mine" needs no other test.
    static constexpr int black_side = 1, white_side = 1 << 4, empty_side = 1 << 8;

    using Liberties = std::conditional_t<tactical, LibertySum, LibertyCount>;
    static constexpr Liberties liberty(int at) { return Liberties(tactical ? at : 1); }
    struct Reckoned {
        LibertyCount liberties;  // pseudo-liberties, at heads
    };
    struct ReckonedTactical {
        LibertySum liberties;  // likewise
        std::uint16_t surroundings = 0;
    };

    struct alignas(16) Cell : std::conditional_t<tactical, ReckonedTactical, Reckoned> {
        std::uint16_t sides = 0;
        std::uint16_t chain = 0;  // head's index; 0, an edge cell, where there is no stone
        std::uint16_t next = 0;
        std::uint16_t slot = 0;        // in empty_
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

    Cell& cell(int at) { return cells_[static_cast<std::size_t>(at)]; }
    const Cell& cell(int at) const { return cells_[static_cast<std::size_t>(at)]; }
    static std::uint16_t word(int n) { return static_cast<std::uint16_t>(n); }

    void place_as_in(const Board& board);
    void count_sides(int at);
    Liberties liberties_of_stone(int at) const;
    void look_around(int at);
    void show_around(int at, Colour colour);
    void list_empty(int at);
    void unlist_empty(int at);

    template <Colour colour>
    bool legal_between_stones(int at) const;
    void join(int at, int other);
    template <Colour colour>
    void take(int at);

    std::array<Cell, cell_count> cells_;
    std::array<std::uint16_t, most_size * most_size> empty_;
    int empty_count_ = 0;
    int ko_ = 0;
    int size_;
};

template <int most_size, bool tactical>
RolloutBoard<most_size, tactical>::RolloutBoard(const Go& game) : size_(game.size()) {
    assert(size_ <= most_size);
    place_as_in(game.board());
    for (int y = 0; y < size_; ++y)
        for (int x = 0; x < size_; ++x) {
            count_sides(index({x, y}));
            look_around(index({x, y}));
        }
    if (const auto ko = game.ko_point()) ko_ = (ko->y + 1) * stride + ko->x + 1;
}

template <int most_size, bool tactical>
void RolloutBoard<most_size, tactical>::place_as_in(const Board& board) {
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
template <int most_size, bool tactical>
void RolloutBoard<most_size, tactical>::count_sides(int at) {
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
    head.liberties += liberties_of_stone(at);
    ++head.chain_size;
}

template <int most_size, bool tactical>
auto RolloutBoard<most_size, tactical>::liberties_of_stone(int at) const -> Liberties {
    if constexpr (!tactical) return LibertyCount(cell(at).sides >> 8);
    Liberties sum;
    for (const int beside : neighbours(at))
        if (cell(beside).colour == Colour::empty) sum += Liberties(beside);
    return sum;
}

template <int most_size, bool tactical>
void RolloutBoard<most_size, tactical>::look_around(int at) {
    if constexpr (tactical) {
        int shift = 0, seen = 0;
        for (const int beside : around(at)) {
            seen |= static_cast<int>(cell(beside).colour) << shift;
            shift += 2;
        }
        cell(at).surroundings = word(seen);
    }
}

// Puts on, or takes off again, a stone in the surroundings of the points around it.
template <int most_size, bool tactical>
void RolloutBoard<most_size, tactical>::show_around(int at, Colour colour) {
    if constexpr (tactical) {
        int shift = 14;  // seen from there, the first of around() is the last
        for (const int seen_from : around(at)) {
            cell(seen_from).surroundings ^= word(static_cast<int>(colour) << shift);
            shift -= 2;
        }
    }
}

template <int most_size, bool tactical>
void RolloutBoard<most_size, tactical>::list_empty(int at) {
    cell(at).slot = word(empty_count_);
    empty_[static_cast<std::size_t>(empty_count_++)] = word(at);
}

template <int most_size, bool tactical>
void RolloutBoard<most_size, tactical>::unlist_empty(int at) {
    const auto last = empty_[static_cast<std::size_t>(--empty_count_)];
    empty_[cell(at).slot] = last;
    cell(last).slot = cell(at).slot;
}

template <int most_size, bool tactical>
template <Colour colour>
bool RolloutBoard<most_size, tactical>::is_eye(int at) const {
    if (count(cell(at).sides, colour) != 4) return false;
    constexpr auto enemy = opponent(colour);
    int enemies = cell(at).at_edge;
    for (const int corner : {at - stride - 1, at - stride + 1, at + stride - 1, at + stride + 1})
        enemies += cell(corner).colour == enemy;
    return enemies < 2;
}

// Of a point without an empty neighbour: does the stone take, or join a chain with another liberty?
template <int most_size, bool tactical>
template <Colour colour>
bool RolloutBoard<most_size, tactical>::legal_between_stones(int at) const {
    if (at == ko_) return false;
    const auto beside = neighbours(at);
    for (const int one : beside) {
        if (cell(one).colour == Colour::edge) continue;
        const int chain = cell(one).chain;
        Liberties left = cell(chain).liberties;
        for (const int other : beside)
            if (cell(other).chain == chain) left -= liberty(at);
        const bool lives = !left.none();
        if (lives == (cell(one).colour == colour)) return true;
    }
    return false;
}

template <int most_size, bool tactical>
void RolloutBoard<most_size, tactical>::join(int at, int other) {
    int head = cell(at).chain;
    if (head == other) return;
    if (cell(head).chain_size < cell(other).chain_size) std::swap(head, other);
    int stone = other;
    do {
        cell(stone).chain = word(head);
        stone = cell(stone).next;
    } while (stone != other);
    std::swap(cell(head).next, cell(other).next);
    cell(head).liberties += cell(other).liberties;
    cell(head).chain_size = word(cell(head).chain_size + cell(other).chain_size);
}

template <int most_size, bool tactical>
template <Colour colour>
void RolloutBoard<most_size, tactical>::take(int at) {
    int stone = at;
    do {
        Cell& gone = cell(stone);
        const int next = gone.next;
        gone.colour = Colour::empty;
        gone.chain = 0;
        for_neighbours(stone, [&](int beside) {
            cell(beside).sides = word(cell(beside).sides + empty_side - side_of(colour));
            cell(cell(beside).chain).liberties += liberty(stone);
        });
        show_around(stone, colour);
        list_empty(stone);
        stone = next;
    } while (stone != at);
}

template <int most_size, bool tactical>
template <Colour colour>
int RolloutBoard<most_size, tactical>::play(int at) {
    constexpr auto enemy = opponent(colour);
    Cell& stone = cell(at);
    const bool in_enemy_eye = count(stone.sides, enemy) == 4;
    unlist_empty(at);
    stone.colour = colour;
    if (stone.first == 0) stone.first = colour == Colour::black ? 1 : -1;
    stone.chain = stone.next = word(at);
    stone.chain_size = 1;
    stone.liberties = liberties_of_stone(at);
    show_around(at, colour);
    for_neighbours(at, [&](int beside) {
        cell(beside).sides = word(cell(beside).sides + side_of(colour) - empty_side);
        // Chain 0 is nobody's: cheaper to count there than to ask whether there is a stone.
        cell(cell(beside).chain).liberties -= liberty(at);
    });
    for_neighbours(at, [&](int beside) {
        if (cell(beside).colour == colour) join(at, cell(beside).chain);
    });
    const int before = empty_count_;
    for_neighbours(at, [&](int beside) {
        if (cell(beside).colour == enemy && cell(cell(beside).chain).liberties.none())
            take<enemy>(beside);
    });
    const bool takes_ko = in_enemy_eye && empty_count_ == before + 1;
    ko_ = takes_ko ? empty_[static_cast<std::size_t>(before)] : 0;
    return empty_count_ - before;
}

template <int most_size, bool tactical>
template <Colour colour, class Accept>
int RolloutBoard<most_size, tactical>::play_random(engine::Random& random, Accept accept) {
    // Points found unfit go behind the rest, out of the draw.
    for (int left = empty_count_; left > 0;) {
        auto& drawn = empty_[static_cast<std::size_t>(random.below(left))];
        const int at = drawn;
        const bool open = cell(at).sides >= empty_side;
        if ((open || (!is_eye<colour>(at) && legal_between_stones<colour>(at))) && accept(at)) {
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

template <int most_size, bool tactical>
std::int8_t RolloutBoard<most_size, tactical>::owner(int x, int y) const {
    const Cell& point = cell((y + 1) * stride + x + 1);
    if (point.colour == Colour::black) return 1;
    if (point.colour == Colour::white) return -1;
    return static_cast<std::int8_t>((count(point.sides, Colour::black) == 4) -
                                    (count(point.sides, Colour::white) == 4));
}

}  // namespace go
