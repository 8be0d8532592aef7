// Self-play on one thread: some dozens of games advanced together, so that the network is always
// asked about full batches and nothing waits. An actor starts no thread and takes no lock; whoever
// owns it calls advance() from one thread over and over, and gets every finished game at once
// through a callback on that thread. Only counts() may be called from other threads. Equal
// settings, seeds and networks give equal games.
//
// Before there is a network worth asking, rollouts can take its place, as in the first iteration of
// expert iteration (Anthony et al. 2017).
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "search/leaf.h"
#include "search/network_leaf.h"
#include "search/symmetry_evaluator.h"
#include "selfplay/training/episode.h"
#include "selfplay/training/resign_watch.h"

namespace selfplay::training {

struct ActorCounts {
    std::uint64_t evaluations = 0;  // positions that the network was asked about
    std::uint64_t games = 0;        // finished
    // Of finished games.
    std::uint64_t positions = 0, taught = 0, resigned = 0;
};

template <engine::Encoded G>
class Actor {
   public:
    using Source = std::shared_ptr<const search::EvaluatorSource<G>>;
    using Finished = std::function<void(records::Game)>;
    static constexpr std::uint64_t endless = std::numeric_limits<std::uint64_t>::max();

    // Plays `games` games in all; without a network, positions are judged by rollouts. Fails with
    // engine::Error on settings that do not fit each other or a network that does not serve the
    // boards.
    Actor(const ActorSettings& settings, std::uint64_t seed, Source network, std::uint64_t steps,
          Finished finished, std::uint64_t games = endless)
        : settings_(settings),
          seed_(seed),
          finished_(std::move(finished)),
          left_(games),
          watch_(settings.resign, settings.resign_turns, settings.resign_errors),
          leaves_(static_cast<std::size_t>(settings.batch)) {
        check(settings);
        set_network(std::move(network), steps);
    }

    // Every later answer comes from this network (none: from rollouts), which has had so many steps
    // of training; searches under way go on with what they know.
    void set_network(Source network, std::uint64_t steps) {
        if (network) check_boards(*network);
        network_ = std::move(network);
        steps_ = steps;
        judges_.clear();
    }
    // Of all turns that begin from now on.
    void set_simulations(int full, int fast) {
        settings_.simulations = full;
        settings_.fast_simulations = fast;
        check(settings_);
        for (const auto& game : games_) game->set_simulations(full, fast);
    }

    // One answer of the network for every game; false when all games are played.
    bool advance() {
        while (games_.size() < static_cast<std::size_t>(settings_.games) && left_ > 0)
            games_.push_back(next_game());
        // By board, since a batch has one.
        if (settings_.least_size > 0)
            std::stable_sort(games_.begin(), games_.end(),
                             [](const auto& a, const auto& b) { return a->board() < b->board(); });
        for (std::size_t at = 0; at < games_.size();) at = advance_batch(at);
        games_.erase(std::remove(games_.begin(), games_.end(), nullptr), games_.end());
        return !games_.empty();
    }

    ActorCounts counts() const {
        return {evaluations_.load(relaxed), ended_.load(relaxed), positions_.load(relaxed),
                taught_.load(relaxed), resigned_.load(relaxed)};
    }
    const ResignWatch& resignation() const { return watch_; }
    int simulations() const { return settings_.simulations; }  // of a full search

   private:
    using Judge = search::LeafEvaluator<G>;
    static constexpr auto relaxed = std::memory_order_relaxed;

    void check_boards(const search::EvaluatorSource<G>& network) const {
        auto sizes = settings_;
        sizes.small_share = 0;
        const int least = settings_.least_size > 0 ? settings_.least_size : settings_.size;
        engine::Random random(0);
        for (sizes.size = least; sizes.size <= settings_.size; ++sizes.size)
            network.check(first_position<G>(sizes, random));
    }

    std::unique_ptr<Episode<G>> next_game() {
        if (left_ != endless) --left_;
        const auto seed = engine::mixed(seed_ + 1, started_++);
        return std::make_unique<Episode<G>>(settings_, seed, watch_.threshold());
    }

    // Games from number `at` on; yields the first behind the batch.
    std::size_t advance_batch(std::size_t at) {
        const int board = games_[at]->board();
        batch_.clear();
        for (; at < games_.size() && batch_.size() < leaves_.size(); ++at) {
            if (games_[at]->board() != board) break;
            if (gather(games_[at], leaves_[batch_.size()])) batch_.push_back(games_[at].get());
        }
        if (batch_.empty()) return at;
        const auto count = batch_.size();
        judge(board).evaluate(std::span(leaves_).first(count));
        evaluations_.fetch_add(count, relaxed);
        for (std::size_t i = 0; i < count; ++i) batch_[i]->absorb(leaves_[i]);
        return at;
    }

    // False when the game has ended and there is no next one on the same board.
    bool gather(std::unique_ptr<Episode<G>>& game, search::Leaf<G>& leaf) {
        const int board = game->board();
        while (!game->gather(leaf)) {
            hand_over(*game);
            game = left_ > 0 ? next_game() : nullptr;
            if (!game || game->board() != board) return false;
        }
        return true;
    }

    void hand_over(Episode<G>& game) {
        auto record = game.take_record();
        record.steps = steps_;
        record.by_rollouts = !network_;
        if (game.plays_on()) watch_.add(record);
        ended_.fetch_add(1, relaxed);
        positions_.fetch_add(record.turns.size(), relaxed);
        taught_.fetch_add(game.taught(), relaxed);
        resigned_.fetch_add(record.ending == records::Ending::resigned, relaxed);
        finished_(std::move(record));
    }

    Judge& judge(int board) {
        for (const auto& [side, judge] : judges_)
            if (side == board) return *judge;
        judges_.emplace_back(board,
                             make_judge(engine::mixed(seed_, static_cast<std::uint64_t>(board))));
        return *judges_.back().second;
    }
    std::unique_ptr<Judge> make_judge(std::uint64_t seed) const {
        if (!network_) return std::make_unique<search::RolloutLeaf<G>>(seed);
        auto evaluator = network_->make_evaluator();
        if (settings_.symmetries)
            evaluator = std::make_unique<search::SymmetryEvaluator<G>>(std::move(evaluator), seed);
        using Leaf = search::NetworkLeaf<G>;
        return std::make_unique<Leaf>(
            std::move(evaluator), false, typename Leaf::Temperatures{},
            typename Leaf::Rollouts(*network_, settings_.lambda, settings_.rollouts, seed));
    }

    ActorSettings settings_;
    std::uint64_t seed_;
    Finished finished_;
    std::uint64_t left_, started_ = 0;  // games
    ResignWatch watch_;
    Source network_;
    std::uint64_t steps_ = 0;
    std::vector<std::pair<int, std::unique_ptr<Judge>>> judges_;  // by board
    std::vector<std::unique_ptr<Episode<G>>> games_;
    std::vector<Episode<G>*> batch_;
    std::vector<search::Leaf<G>> leaves_;  // of the batch
    std::atomic<std::uint64_t> evaluations_ = 0, ended_ = 0, positions_ = 0, taught_ = 0,
                               resigned_ = 0;
};

}  // namespace selfplay::training
