// What a search has found, as protocols show it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "search/clock.h"
#include "search/tree.h"
#include "search/tree_search.h"

namespace search {

using engine::Move;

// One root move as the search sees it now, best first in Analysis::moves.
struct MoveAnalysis {
    Move move;
    std::uint64_t visits = 0;
    float prior = 0;  // 0..1
    float value = 0;  // mean, in [-1, 1], as the player to move at the root sees it
    float lcb = 0;    // lower confidence bound of `value`
    float draws = 0;  // how likely a draw is, 0..1
    // Plies to the end of the game, this move counted, where it is sure: to a win, or negative to a
    // loss, 0 for a draw.
    std::optional<int> sure;
    std::vector<Move> variation;                  // principal variation, `move` first
    std::vector<std::uint64_t> variation_visits;  // one a move of it
};

struct Analysis {
    std::uint64_t visits = 0;       // of the root, kept ones included
    std::uint64_t simulations = 0;  // of this think
    float value = 0;                // of the root, as the player to move sees it
    float lead = 0;                 // mean lead of the player to move, where the game counts points
    float draws = 0;                // how likely a draw is, 0..1
    float draw_score = 0;           // what a draw counts for in the values
    float plies_left = 0;           // of the game, where the network has a word on it
    Milliseconds elapsed{0};
    int depth = 0, deepest = 0;  // mean and greatest length of a simulation's descent
    float memory_used = 0;       // share of the budget, 0..1
    std::vector<MoveAnalysis> moves;
    // Expected owner of every point in [-1, 1], +1 the root's mover; empty in games without
    // territory.
    std::vector<float> owners;
    std::string fault;  // why the think broke off, in one line; empty when all went well
};

// How the moves of a root are told.
struct Telling {
    int most_moves = 0x7fffffff, variation_length = 32;
    float draw_score = 0;
    std::optional<Move> first;  // comes first whatever is known of it
    bool by_bound = false;  // else the one of the highest lower bound among the well visited does
};

// The root's moves that `filter` allows, best first: sure wins, the shortest ahead, then the most
// visited, of equals the best valued, then sure losses.
std::vector<MoveAnalysis> describe_moves(const Tree& tree, const MoveFilter& filter,
                                         const Telling& telling);

// What decides whether a think may end: how the two most visited root moves stand.
struct Standing {
    std::uint64_t first_visits = 0, second_visits = 0;
    bool first_is_best = true;  // the most visited move also has the best value
    float value = 0;            // of the most visited, as the root's mover sees it
    Move first;
    int moves = 0;         // to choose from
    bool decided = false;  // one is a sure win, or at most one is not a sure loss, or all are sure
};
Standing standing(const Tree& tree, const MoveFilter& filter);

}  // namespace search
