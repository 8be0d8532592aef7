// One worker's life in a think: simulation after simulation until told to stop. Its counts may be
// read from any thread.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "search/analysis.h"
#include "search/gumbel.h"
#include "search/limits.h"
#include "search/meeting.h"
#include "search/relaxed.h"
#include "search/tree_search.h"

namespace search {

// What the workers of one think share.
struct Team {
    static constexpr std::uint64_t endless = ~std::uint64_t{0};

    std::atomic<bool> stop = false;
    std::atomic<std::uint64_t> started = 0;      // simulations
    std::atomic<std::uint64_t> limit = endless;  // of them
    bool early_end = false;  // before the limit, once the best move can no longer be caught
    std::uint64_t check_every = 256;   // simulations, whether it can be
    int batch = 1;                     // leaves asked about at once, in a tree large enough
    bool meets_at_root = false;        // as soon as the root has its moves
    std::atomic<bool> full = false;    // is the tree
    std::optional<GumbelRoot> gumbel;  // with what moves to begin; changes at meetings only
    Meeting meeting;
};

template <engine::Game G>
class Worker {
   public:
    explicit Worker(std::unique_ptr<LeafEvaluator<G>> evaluator)
        : evaluator_(std::move(evaluator)), leaves_(most_batch) {}

    std::uint64_t simulations() const { return simulations_.load(relaxed); }
    std::uint64_t steps() const { return steps_.load(relaxed); }
    std::uint64_t deepest() const { return deepest_.load(relaxed); }
    OwnerTally* tally() { return evaluator_->tally(); }

    void warm_up(const G& game, int batch) { evaluator_->warm_up(game, batch); }
    void reset_counts() { simulations_ = steps_ = deepest_ = 0; }

    // Returns when the team stops, its limit is reached or the root has nothing to search.
    // `meet` is what a meeting is for: it makes room in a full tree and prepares a new root.
    // Whatever the evaluator throws passes through, with no trace left in the tree.
    template <class Meet>
    void work(TreeSearch<G>& search, Team& team, Meet meet) {
        const Membership membership(team.meeting);
        bool turn = false;  // taken and not used yet
        while (!told_to_stop(search, team)) {
            if (team.meeting.called()) team.meeting.attend(meet);
            const bool over = exhausted(search) || !(turn = turn || take_turn(search, team));
            if (over) return;
            turn = !simulate(search, team);
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
        return team.stop.load(relaxed) && search.tree()[search.tree().root()].expanded();
    }

    // The game is over at the root, or the visit counts are about to run out of bits.
    static bool exhausted(const TreeSearch<G>& search) {
        constexpr std::uint32_t most_visits = 0xfff00000;
        const Node& root = search.tree()[search.tree().root()];
        return root.decided() || root.visits.load(relaxed) > most_visits;
    }

    static bool take_turn(const TreeSearch<G>& search, Team& team) {
        const auto turn = team.started.fetch_add(1, relaxed);
        const auto limit = team.limit.load(relaxed);
        if (turn >= limit) return false;
        const bool check = team.early_end && limit != Team::endless && turn % team.check_every == 0;
        return !check || turn == 0 ||
               !settled(standing(search.tree(), search.filter()), limit - turn);
    }

    // Leaves to gather at once. The later ones of a batch are chosen without what the earlier will
    // say, which few visits would not forgive.
    static std::size_t most_leaves(const TreeSearch<G>& search, const Team& team) {
        constexpr std::uint32_t visits_a_leaf = 16;
        const auto visits = search.tree()[search.tree().root()].visits.load(relaxed);
        return std::min<std::size_t>(static_cast<std::size_t>(team.batch),
                                     1 + visits / visits_a_leaf);
    }

    // With a turn for the first; false when it was not used.
    bool simulate(TreeSearch<G>& search, Team& team) {
        std::size_t gathered = 0;
        bool used = gather(search, team, gathered);
        // What is proven may draw every descent to itself: it is these that are counted.
        const auto most = most_leaves(search, team);
        for (std::size_t tried = 1; used && gathered > 0 && tried < most && take_turn(search, team);
             ++tried)
            if (!(used = gather(search, team, gathered))) team.started.fetch_sub(1);
        if (gathered == 0) return used;
        evaluate(search, std::span(leaves_).first(gathered));
        for (std::size_t i = 0; i < gathered; ++i) {
            const bool fits = search.absorb(leaves_[i]);
            if (!fits) call_for_room(team);
            if (fits && leaves_[i].expands) evaluator_->defer(leaves_[i]);
            const bool new_root = leaves_[i].expands && leaves_[i].path.size() == 1;
            if (new_root && team.meets_at_root) team.meeting.call();
            count(leaves_[i]);
        }
        for (const Leaf<G>& leaf : evaluator_->judge_deferred()) search.absorb_late(leaf);
        if (const int visits = evaluator_->visits_to_expand(); visits > 0)
            search.set_visits_to_expand(visits);
        return true;
    }

    // One descent; false when nothing came of it.
    bool gather(TreeSearch<G>& search, Team& team, std::size_t& gathered) {
        Leaf<G>& leaf = leaves_[gathered];
        const auto first = team.gumbel ? std::optional(team.gumbel->next()) : std::nullopt;
        switch (search.gather(leaf, evaluator_->shares_leaves(), first)) {
            case Gathered::absorbed:
                return count(leaf);
            case Gathered::taken:
                return false;
            case Gathered::full:
                return call_for_room(team), false;
            case Gathered::leaf:
                break;
        }
        return ++gathered, true;
    }

    static void call_for_room(Team& team) {
        team.full = true;
        team.meeting.call();
    }

    void evaluate(TreeSearch<G>& search, std::span<Leaf<G>> leaves) {
        try {
            evaluator_->evaluate(leaves);
        } catch (...) {
            for (const auto& leaf : leaves) search.abandon(leaf);
            throw;
        }
    }

    bool count(const Leaf<G>& leaf) {
        const auto length = leaf.path.size() - 1;
        simulations_.store(simulations() + 1, relaxed);
        steps_.store(steps() + length, relaxed);
        deepest_.store(std::max<std::uint64_t>(deepest(), length), relaxed);
        return true;
    }

    std::unique_ptr<LeafEvaluator<G>> evaluator_;
    std::vector<Leaf<G>> leaves_;
    std::atomic<std::uint64_t> simulations_ = 0, steps_ = 0, deepest_ = 0;
};

}  // namespace search
