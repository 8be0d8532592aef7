#include "engine/go/board.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace go {

namespace {

constexpr std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
}

// One random word a colour and point, in the order of the board's indices.
constexpr auto zobrist = [] {
    std::array<std::uint64_t, 2048> table{};
    for (std::size_t i = 0; i < table.size(); ++i) table[i] = mix(0x9e3779b97f4a7c15 * (i + 1));
    return table;
}();

std::uint64_t stone_key(int at, Colour colour) {
    return zobrist[static_cast<std::size_t>(at) + (colour == Colour::white ? 1024u : 0u)];
}

// Sets of points to which one is added at a time: true where it is new.
constexpr int few_liberties = 4;
class Few {
   public:
    bool add(int at) {
        for (std::size_t i = 0; i < count_; ++i)
            if (points_[i] == at) return false;
        points_[count_++] = at;
        return true;
    }

   private:
    std::array<int, few_liberties> points_;
    std::size_t count_ = 0;
};
class Many {
   public:
    bool add(int at) {
        const auto point = static_cast<std::size_t>(at);
        if (points_[point]) return false;
        return points_.set(point), true;
    }

   private:
    std::bitset<1024> points_;
};

std::size_t side(Colour colour) { return colour == Colour::white ? 1 : 0; }

}  // namespace

Board::Board(int size) : size_(size) {
    assert(size >= min_size && size <= max_size);
    cells_.fill(Cell(Colour::edge));
    for_each_point([this](int at) { cell(at) = Cell(Colour::empty); });
}

Board::Board(int size, const Stones& stones) : Board(size) {
    std::size_t point = 0;
    for_each_point([&](int at) {
        if (stones[0][point]) put(at, Colour::black);
        if (stones[1][point]) put(at, Colour::white);
        ++point;
    });
}

bool Board::holds(int at) const {
    return at > 0 && at < stride() * (size_ + 1) && cell(at).colour() != Colour::edge;
}

template <class Seen>
int Board::distinct_liberties(int at, int most) const {
    Seen seen;
    int count = 0, stone = at;
    do {
        for (const int beside : neighbours(stone)) {
            if (this->at(beside) != Colour::empty || !seen.add(beside)) continue;
            if (++count == most) return most;
        }
        stone = next(stone);
    } while (stone != at);
    return count;
}

int Board::liberties(int at, int most) const {
    const int sides = cell(head(at)).liberties();
    if (sides <= 1) return std::min(sides, most);
    // A point has four sides at most.
    if (sides > 4 * (most - 1)) return most;
    return most <= few_liberties ? distinct_liberties<Few>(at, most)
                                 : distinct_liberties<Many>(at, most);
}

bool Board::fills_last_liberty(int at, int beside) const {
    const int chain = head(beside);
    int sides = 0;
    for (const int other : neighbours(at))
        sides += is_stone(this->at(other)) && head(other) == chain;
    return cell(chain).liberties() == sides;
}

bool Board::captures(int at, Colour colour) const {
    for (const int beside : neighbours(at))
        if (this->at(beside) == opponent(colour) && fills_last_liberty(at, beside)) return true;
    return false;
}

bool Board::is_suicide(int at, Colour colour) const {
    for (const int beside : neighbours(at)) {
        const auto there = this->at(beside);
        if (there == Colour::empty) return false;
        if (there != Colour::edge && fills_last_liberty(at, beside) != (there == colour))
            return false;
    }
    return true;
}

std::uint64_t Board::chain_key(int at) const {
    std::uint64_t key = 0;
    for_each_stone(at, [&](int stone) { key ^= stone_key(stone, this->at(stone)); });
    return key;
}

std::uint64_t Board::key_after(int at, Colour colour) const {
    const bool suicide = is_suicide(at, colour);
    auto key = suicide ? key_ : key_ ^ stone_key(at, colour);
    std::array<int, 4> taken{};
    std::size_t count = 0;
    for (const int beside : neighbours(at)) {
        if (this->at(beside) != (suicide ? colour : opponent(colour))) continue;
        if (!fills_last_liberty(at, beside)) continue;
        bool known = false;
        for (std::size_t i = 0; i < count; ++i) known = known || taken[i] == head(beside);
        if (known) continue;
        taken[count++] = head(beside);
        key ^= chain_key(beside);
    }
    return key;
}

void Board::add_liberty_beside(int at, int count) {
    for (const int beside : neighbours(at))
        if (is_stone(this->at(beside))) cell(head(beside)).add_liberties(count);
}

void Board::join(int a, int b) {
    a = head(a);
    b = head(b);
    if (a == b) return;
    int stone = b;
    do {
        cell(stone).set_head(a);
        stone = cell(stone).next();
    } while (stone != b);
    const int after_a = cell(a).next();
    cell(a).set_next(cell(b).next());
    cell(b).set_next(after_a);
    cell(a).add_liberties(cell(b).liberties());
}

void Board::put(int at, Colour colour) {
    assert(this->at(at) == Colour::empty);
    add_liberty_beside(at, -1);
    cell(at) = Cell(colour, at);
    stones_[side(colour)].set(order(at));
    key_ ^= stone_key(at, colour);
    for (const int beside : neighbours(at))
        if (this->at(beside) == Colour::empty) cell(at).add_liberties(1);
    for (const int beside : neighbours(at))
        if (this->at(beside) == colour) join(beside, at);
}

int Board::take_chain(int at) {
    const auto colour = this->at(at);
    int taken = 0;
    int stone = at;
    do {
        const int next = cell(stone).next();
        cell(stone) = Cell(Colour::empty);
        stones_[side(colour)].reset(order(stone));
        key_ ^= stone_key(stone, colour);
        // Stones of this chain still on get liberties too, but go themselves.
        add_liberty_beside(stone, 1);
        ++taken;
        stone = next;
    } while (stone != at);
    return taken;
}

Board::Taken Board::play(int at, Colour colour) {
    put(at, colour);
    Taken taken;
    for (const int beside : neighbours(at))
        if (this->at(beside) == opponent(colour) && !has_liberty(beside)) {
            taken.enemy += take_chain(beside);
            taken.last = beside;
        }
    if (!has_liberty(at)) {
        taken.own = take_chain(at);
        taken.last = at;
    }
    return taken;
}

void Board::set_up(int at, Colour colour) {
    Board fresh(size_);
    for_each_point([&](int point) {
        const auto stone = point == at ? colour : this->at(point);
        if (is_stone(stone)) fresh.put(point, stone);
    });
    *this = fresh;
}

}  // namespace go
