#include "engine/go/ladder.h"

#include <algorithm>
#include <functional>

namespace go {

namespace {

constexpr int most_nodes = 25000;

class Moves {
   public:
    void add(int at) {
        if (std::find(begin(), end(), at) == end() && count_ < most) moves_[count_++] = at;
    }
    const int* begin() const { return moves_.data(); }
    const int* end() const { return moves_.data() + count_; }
    std::size_t size() const { return count_; }
    int operator[](std::size_t i) const { return moves_[i]; }

   private:
    static constexpr std::size_t most = 64;
    std::array<int, most> moves_{};
    std::size_t count_ = 0;
};

void add_liberties(const Board& board, int stone, Moves& moves) {
    board.for_each_stone(stone, [&](int at) {
        for (const int beside : board.neighbours(at))
            if (board.at(beside) == Colour::empty) moves.add(beside);
    });
}

// Where the chain's owner takes a chain beside it.
void add_saving_captures(const Board& board, int stone, Moves& moves) {
    const auto enemy = opponent(board.at(stone));
    board.for_each_stone(stone, [&](int at) {
        for (const int beside : board.neighbours(at))
            if (board.at(beside) == enemy && board.liberties(beside, 2) == 1)
                add_liberties(board, beside, moves);
    });
}

int free_neighbours(const Board& board, int at) {
    int count = 0;
    for (const int beside : board.neighbours(at)) count += board.at(beside) == Colour::empty;
    return count;
}

// Seen without playing it: a chain of `owner` whose last liberty is `move` gets three or more by
// it. `filled`: how many of the liberties that the board shows there the other side will have
// taken.
bool surely_escapes(const Board& board, int move, Colour owner, int filled) {
    const auto beside = board.neighbours(move);
    return free_neighbours(board, move) >= 3 + filled ||
           std::any_of(beside.begin(), beside.end(), [&](int at) {
               return board.at(at) == owner && board.liberties(at, 4 + filled) >= 4 + filled;
           });
}

class Reader {
   public:
    explicit Reader(const Board& board, int stone)
        : stone_(stone),
          owner_(board.at(stone)),
          most_depth_(board.size() * board.size() * 3 / 2 + 1) {}

    // The owner is to move.
    bool captured_on_defence(const LadderBoard& position, int depth) {
        const auto& board = position.board;
        if (board.liberties(stone_, 2) >= 2) return false;
        // What only works through a ko does not count.
        if (position.ko != 0) return false;
        Moves moves;
        add_saving_captures(board, stone_, moves);
        add_liberties(board, stone_, moves);
        for (const int move : moves) {
            if (!may_play(position, move, owner_)) continue;
            if (depth + 1 < most_depth_ && extends(board, move) &&
                surely_escapes(board, move, owner_, 0)) {
                count_node();
                return false;
            }
            LadderBoard next = position;
            next.play(move, owner_);
            if (!captured_on_attack(next, depth + 1)) return false;
            if (gave_up_) return false;
        }
        return true;
    }

    static bool may_play(const LadderBoard& position, int move, Colour colour) {
        const auto& board = position.board;
        return board.at(move) == Colour::empty && move != position.ko &&
               !board.is_suicide(move, colour);
    }

    bool gave_up() const { return gave_up_; }

   private:
    bool captured_on_attack(const LadderBoard& position, int depth) {
        count_node();
        if (gave_up_) return false;
        if (depth >= most_depth_) return true;
        const auto& board = position.board;
        const int liberties = board.liberties(stone_, 3);
        if (liberties <= 1) return true;
        if (liberties >= 3) return false;
        Moves moves;
        add_liberties(board, stone_, moves);
        if (dies_between_kos(board, moves)) return true;
        if (free_neighbours(board, moves[1]) > free_neighbours(board, moves[0]))
            moves = reversed(moves);
        for (const int move : moves) {
            if (!may_play(position, move, opponent(owner_))) continue;
            LadderBoard next = position;
            next.play(move, opponent(owner_));
            if (captured_on_defence(next, depth + 1)) return true;
            if (gave_up_) return false;
        }
        return false;
    }

    void count_node() {
        if (++nodes_ > most_nodes) gave_up_ = true;
    }

    // Is the move one beside the chain?
    bool extends(const Board& board, int move) const {
        const auto beside = board.neighbours(move);
        return std::any_of(beside.begin(), beside.end(), [&](int at) {
            return board.at(at) == owner_ && board.head(at) == board.head(stone_);
        });
    }

    static Moves reversed(const Moves& moves) {
        Moves result;
        for (std::size_t i = moves.size(); i-- > 0;) result.add(moves[i]);
        return result;
    }

    // Both liberties are mouths of kos that the owner cannot connect out of.
    bool dies_between_kos(const Board& board, const Moves& liberties) const {
        const auto is_mouth = [&](int at) {
            return free_neighbours(board, at) == 0 && is_ko_mouth(board, at);
        };
        if (!std::all_of(liberties.begin(), liberties.end(), is_mouth)) return false;
        Moves captures;
        add_saving_captures(board, stone_, captures);
        if (captures.size() > 0) return false;
        return std::all_of(liberties.begin(), liberties.end(), [&](int at) {
            Board next = board;
            next.play(at, owner_);
            return next.liberties(at, 3) <= 2;
        });
    }

    // Would the attacker, playing there, take exactly one stone with a stone that stands alone?
    bool is_ko_mouth(const Board& board, int at) const {
        int in_atari = 0;
        for (const int beside : board.neighbours(at)) {
            const auto colour = board.at(beside);
            if (colour != owner_ && colour != Colour::edge) return false;
            if (colour != owner_ || board.liberties(beside, 2) != 1) continue;
            ++in_atari;
            if (!board.is_lone_stone(beside)) return false;
        }
        return in_atari == 1;
    }

    int stone_;
    Colour owner_;
    int most_depth_;
    int nodes_ = 0;
    bool gave_up_ = false;
};

}  // namespace

void LadderBoard::play(int at, Colour colour) {
    const auto taken = board.play(at, colour);
    const bool takes_ko =
        taken.enemy == 1 && board.is_lone_stone(at) && board.liberties(at, 2) == 1;
    ko = takes_ko ? taken.last : 0;
}

bool dies_in_ladder(const LadderBoard& position, int stone) {
    // The owner may break a ko ban at the start, by a threat elsewhere.
    if (position.ko != 0) return dies_in_ladder({position.board, 0}, stone);
    const auto& board = position.board;
    Moves liberties;
    add_liberties(board, stone, liberties);
    // Whatever else was read, this would refute it.
    if (liberties.size() != 1 || surely_escapes(board, liberties[0], board.at(stone), 0))
        return false;
    Reader reader(board, stone);
    return reader.captured_on_defence(position, 0) && !reader.gave_up();
}

std::vector<int> ladder_captures(const LadderBoard& position, int stone) {
    std::vector<int> working;
    if (position.board.liberties(stone, 3) != 2) return working;
    Moves liberties;
    add_liberties(position.board, stone, liberties);
    const auto owner = position.board.at(stone), attacker = opponent(owner);
    for (const int move : liberties) {
        if (!Reader::may_play(position, move, attacker)) continue;
        const int last = liberties[move == liberties[0] ? 1 : 0];
        if (!position.board.captures(move, attacker) &&
            surely_escapes(position.board, last, owner, 1))
            continue;
        LadderBoard next = position;
        next.play(move, attacker);
        if (dies_in_ladder(next, stone)) working.push_back(move);
    }
    return working;
}

Ladders read_ladders(const LadderBoard& position) {
    const auto& board = position.board;
    Ladders read;
    const auto stands = [&](int chain) {
        board.for_each_stone(chain, [&](int at) { read.stones.set(board.order(at)); });
    };
    board.for_each_point([&](int at) {
        const auto colour = board.at(at);
        if (colour == Colour::empty || board.head(at) != at) return;
        const int liberties = board.liberties(at, 3);
        if (liberties == 1 && dies_in_ladder(position, at)) stands(at);
        if (liberties != 2) return;
        const auto captures = ladder_captures(position, at);
        if (!captures.empty()) stands(at);
        for (const int move : captures)
            read.captures[colour == Colour::black ? 0 : 1].set(board.order(move));
    });
    return read;
}

LadderMemory& LadderMemory::of_this_thread() {
    thread_local LadderMemory memory;
    return memory;
}

LadderMemory::Entry& LadderMemory::entry_of(int size, const Stones& stones) {
    const std::hash<PointSet> hash;
    const auto key = hash(stones[0]) * 31 + hash(stones[1]) + static_cast<std::size_t>(size);
    return entries_[key % entries];
}

}  // namespace go
