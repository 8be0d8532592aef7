// Reads ladders: can a chain be captured by ataris alone? For the input planes of networks, so the
// answers are those that KataGo's networks were trained with (FORMATS.md 1.5), down to where the
// reading gives up.
#pragma once

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

// Calls action(stone, captures) for one stone of every chain that stands in a working ladder: of
// one liberty (captures is empty then) or of two.
template <class Action>
void for_each_ladder(const LadderBoard& position, Action action) {
    position.board.for_each_point([&](int at) {
        const auto colour = position.board.at(at);
        if (colour == Colour::empty || position.board.head(at) != at) return;
        const int liberties = position.board.liberties(at, 3);
        if (liberties == 1 && dies_in_ladder(position, at)) action(at, std::vector<int>{});
        if (liberties != 2) return;
        const auto captures = ladder_captures(position, at);
        if (!captures.empty()) action(at, captures);
    });
}

}  // namespace go
