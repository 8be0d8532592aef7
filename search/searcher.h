// The search that a protocol talks to: a tree, workers on their own threads, and the limits
// of a think. One owner calls everything here from one thread; only the callbacks come from
// another.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/game.h"
#include "search/clock.h"
#include "search/params.h"

namespace search {

using engine::Move;

// What bounds one think; nothing set means until stop().
struct Limits {
    std::optional<std::uint64_t> simulations;  // run by this think
    std::optional<Milliseconds> time;          // exactly this long
    std::optional<TimeLeft> clock;             // as the clock thinks best
    bool ponder = false;                       // limits take effect at ponder_hit()
    std::vector<Move> only, avoid;             // root moves; `only` empty: all
    std::optional<Milliseconds> report_every;  // no reports unless set
};

// One root move as the search sees it now, best first in Analysis::moves.
struct MoveAnalysis {
    Move move;
    std::uint64_t visits = 0;
    float prior = 0;              // 0..1
    float value = 0;              // mean, in [-1, 1], as the player to move at the root sees it
    float lcb = 0;                // lower confidence bound of `value`
    std::vector<Move> variation;  // principal variation, `move` first
    std::vector<std::uint64_t> variation_visits;  // one a move of it
};

struct Analysis {
    std::uint64_t visits = 0;       // of the root, kept ones included
    std::uint64_t simulations = 0;  // of this think
    float value = 0;                // of the root, as the player to move sees it
    float lead = 0;                 // mean lead of the player to move, where the game counts points
    Milliseconds elapsed{0};
    int depth = 0, deepest = 0;  // mean and greatest length of a simulation's descent
    float memory_used = 0;       // share of the budget, 0..1
    std::vector<MoveAnalysis> moves;
    // Expected owner of every point in [-1, 1], +1 the root's mover; empty in games without
    // territory.
    std::vector<float> owners;
};

template <engine::Game G>
class Searcher {
   public:
    explicit Searcher(const SearchParams& params);
    ~Searcher();  // stops

    // Takes effect at the next think; a changed memory budget or thread count rebuilds the tree.
    void set_params(const SearchParams& params);
    const SearchParams& params() const;

    // The position to think about. Keeps the part of the tree that the position shares when it
    // comes after the present one by moves of the tree (`moves` since then); else starts anew.
    void set_position(const G& root);
    void advance(Move move);
    void clear();  // forgets the tree

    // Returns at once. `report` and `done` are called from a thread of the search; `done` exactly
    // once a think, after which the search is idle. While it runs only stop(), interrupt(),
    // ponder_hit() and analysis() may be called.
    void start(const Limits& limits, std::function<void(const Analysis&)> report,
               std::function<void(const Analysis&)> done);
    // Ends the think within 5 ms and returns when `done` has returned.
    void stop();
    void ponder_hit();
    bool thinking() const;

    // A consistent picture, at any time, from any thread; the last think's when idle.
    Analysis analysis(int most_moves = 0x7fffffff, int variation_length = 32) const;

    // start, wait for the end, return the picture. For callers without a protocol.
    Analysis think(const Limits& limits);

   private:
    // …
};

}  // namespace search
