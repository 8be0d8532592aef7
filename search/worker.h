// One worker's life in a think: simulation after simulation until told to stop. Its counts may be
// read from any thread.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>

#include "search/analysis.h"
#include "search/limits.h"
#include "search/meeting.h"
#include "search/tree_search.h"

namespace search {

// What the workers of one think share.
struct Team {
    static constexpr std::uint64_t endless = ~std::uint64_t{0};

    std::atomic<bool> stop = false;
    std::atomic<std::uint64_t> started = 0;      // simulations
    std::atomic<std::uint64_t> limit = endless;  // of them
    bool early_end = false;  // before the limit, once the best move can no longer be caught
    Meeting meeting;
};

template <engine::Game G>
class Worker {
   public:
    explicit Worker(std::unique_ptr<LeafEvaluator<G>> evaluator)
        : evaluator_(std::move(evaluator)) {}

    std::uint64_t simulations() const { return simulations_.load(std::memory_order_relaxed); }
    std::uint64_t steps() const { return steps_.load(std::memory_order_relaxed); }
    std::uint64_t deepest() const { return deepest_.load(std::memory_order_relaxed); }
    OwnerTally* tally() { return evaluator_->tally(); }

    void reset_counts() { simulations_ = steps_ = deepest_ = 0; }

    // Returns when the team stops, its limit is reached or the root has nothing to search.
    // `flip` makes room in a full tree. Whatever the evaluator throws passes through, with no
    // trace left in the tree.
    template <class Flip>
    void work(TreeSearch<G>& search, Team& team, Flip flip) {
        const Membership membership(team.meeting);
        while (!told_to_stop(search, team)) {
            if (team.meeting.called()) team.meeting.attend(flip);
            if (exhausted(search) || !take_turn(search, team)) return;
            while (!simulate(search, team)) {
                if (told_to_stop(search, team)) return;
                if (team.meeting.called()) team.meeting.attend(flip);
            }
        }
    }

   private:
    struct Membership {
        explicit Membership(Meeting& at) : meeting(at) { meeting.join(); }
        Membership(const Membership&) = delete;
        Membership& operator=(const Membership&) = delete;
        ~Membership() { meeting.leave(); }
        Meeting& meeting;
    };

    // However short the think, there must be moves to choose from.
    static bool told_to_stop(const TreeSearch<G>& search, const Team& team) {
        return team.stop.load(std::memory_order_relaxed) &&
               search.tree()[search.tree().root()].expanded();
    }

    // The game is over at the root, or the visit counts are about to run out of bits.
    static bool exhausted(const TreeSearch<G>& search) {
        constexpr std::uint32_t most_visits = 0xfff00000;
        const Node& root = search.tree()[search.tree().root()];
        const auto ending = root.ending.load(std::memory_order_relaxed);
        return (ending != Ending::unknown && ending != Ending::none) ||
               root.visits.load(std::memory_order_relaxed) > most_visits;
    }

    static bool take_turn(const TreeSearch<G>& search, Team& team) {
        constexpr std::uint64_t check_every = 256;
        const auto turn = team.started.fetch_add(1, std::memory_order_relaxed);
        const auto limit = team.limit.load(std::memory_order_relaxed);
        if (turn >= limit) return false;
        const bool check = team.early_end && limit != Team::endless && turn % check_every == 0;
        return !check || turn == 0 ||
               !settled(standing(search.tree(), search.filter()), limit - turn);
    }

    // False when nothing came of it.
    bool simulate(TreeSearch<G>& search, Team& team) {
        switch (search.gather(leaf_, evaluator_->shares_leaves())) {
            case Gathered::absorbed:
                return count();
            case Gathered::taken:
                return false;
            case Gathered::full:
                return team.meeting.call(), false;
            case Gathered::leaf:
                break;
        }
        try {
            evaluator_->evaluate({&leaf_, 1});
        } catch (...) {
            search.abandon(leaf_);
            throw;
        }
        if (!search.absorb(leaf_)) team.meeting.call();
        return count();
    }

    bool count() {
        constexpr auto relaxed = std::memory_order_relaxed;
        const auto length = leaf_.path.size() - 1;
        simulations_.store(simulations() + 1, relaxed);
        steps_.store(steps() + length, relaxed);
        deepest_.store(std::max<std::uint64_t>(deepest(), length), relaxed);
        return true;
    }

    std::unique_ptr<LeafEvaluator<G>> evaluator_;
    Leaf<G> leaf_;
    std::atomic<std::uint64_t> simulations_ = 0, steps_ = 0, deepest_ = 0;
};

}  // namespace search
