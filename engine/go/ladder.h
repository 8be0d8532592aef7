// Reads ladders: can a chain be captured by ataris alone? For the input planes of networks, so the
// answers are those that KataGo's networks were trained with (FORMATS.md 1.5), down to where the
// reading gives up.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "engine/go/board.h"

namespace go {

// `ko` is the index that a simple ko forbids to the player who would take there, 0 for none.
struct LadderBoard {
    Board board;
    int ko = 0;

    // Puts a stone on an empty point and notes the ko that it leaves.
    void play(int at, Colour colour);
};

// Is the chain at `stone`, of one liberty, taken even if its owner moves first?
bool dies_in_ladder(const LadderBoard& position, int stone);

// The moves, of the two liberties of the chain at `stone`, with which the opponent starts a ladder
// that works; none where the chain has another number of liberties.
std::vector<int> ladder_captures(const LadderBoard& position, int stone);

// The points of a board's working ladders, in its order.
struct Ladders {
    PointSet stones;                   // of all chains in one, of one liberty or of two
    std::array<PointSet, 2> captures;  // the moves that start one against Black's and White's
};
Ladders read_ladders(const LadderBoard& position);

// What this thread has read of boards without a ko. Networks are shown the ladders of the last
// three boards, and a search or a game that goes on by a move has read two of them before.
class LadderMemory {
   public:
    // `board()` makes the board that has these stones; it is called where they are not known.
    template <class MakeBoard>
    const Ladders& recall(int size, const Stones& stones, MakeBoard board) {
        Entry& entry = entry_of(size, stones);
        if (entry.size != size || entry.stones != stones)
            entry = {size, stones, read_ladders({board(), 0})};
        return entry.ladders;
    }
    static LadderMemory& of_this_thread();

   private:
    struct Entry {
        int size = 0;
        Stones stones;
        Ladders ladders;
    };
    static constexpr std::size_t entries = 1024;  // some 400 KB

    Entry& entry_of(int size, const Stones& stones);

    std::vector<Entry> entries_{entries};
};

}  // namespace go
