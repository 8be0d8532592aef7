// Our own search as a player of a match, in this process.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <stop_token>
#include <utility>

#include "engine/base/error.h"
#include "search/searcher.h"
#include "selfplay/player.h"

namespace selfplay {

template <engine::Game G>
class InProcessPlayer final : public Player {
   public:
    using Start = std::function<G(const GameSetup&)>;
    using Source = std::shared_ptr<const search::EvaluatorSource<G>>;
    using Load = std::function<Source(const G& start)>;

    // `start` makes the position before the first move; `load`, which may be empty, the network.
    // Without `simulations` a move takes the time that the clock allots.
    InProcessPlayer(const search::SearchParams& params, std::optional<std::uint64_t> simulations,
                    Start start, Load load, std::stop_token stop)
        : searcher_(params),
          simulations_(simulations),
          start_(std::move(start)),
          load_(std::move(load)),
          stop_(std::move(stop)) {}

    std::string name() const override { return "sanban"; }

    void new_game(const GameSetup& setup, engine::Player, Deadline) override {
        if (!simulations_ && setup.time.unlimited)
            engine::fail("an internal player needs a time control or a number of visits");
        const auto start = start_(setup);
        searcher_.set_position(start);
        ply_ = 0;
        if (!load_) return;
        searcher_.set_network(std::exchange(load_, {})(start));
        searcher_.warm_up();
    }

    void play(engine::Player, std::string_view text, Deadline) override {
        const auto move = searcher_.position().move_from_text(text);
        if (!move) engine::fail("internal player: illegal move {}", text);
        searcher_.advance(*move);
        ++ply_;
    }

    Answer think(engine::Player mover, const Clocks& clocks, Deadline deadline) override {
        search::Limits limits;
        limits.ply = ply_++;
        limits.simulations = simulations_;
        if (!simulations_) limits.clock = clocks[static_cast<std::size_t>(mover)];
        const auto best = best_move(limits, deadline);
        Answer answer;
        answer.move = searcher_.position().move_to_text(best);
        searcher_.advance(best);
        return answer;
    }

   private:
    engine::Move best_move(const search::Limits& limits, Deadline deadline) {
        bool done = false;
        searcher_.start(limits, {}, [&](const search::Analysis&) {
            const std::lock_guard lock(mutex_);
            done = true;
            changed_.notify_one();
        });
        const bool stopped = !wait(done, deadline);
        searcher_.stop();
        if (stopped && stop_.stop_requested()) throw Fault(Fault::Kind::stopped, "match stopped");
        if (stopped) throw Fault(Fault::Kind::hang, "no answer");
        const auto picture = searcher_.analysis(1);
        if (!picture.moves.empty()) return picture.moves.front().move;
        return searcher_.position().legal_moves()[0];
    }

    // Whether the think came to its end by itself.
    bool wait(const bool& done, Deadline deadline) {
        std::unique_lock lock(mutex_);
        return changed_.wait_until(lock, stop_, deadline, [&] { return done; });
    }

    search::Searcher<G> searcher_;
    std::optional<std::uint64_t> simulations_;
    Start start_;
    Load load_;  // until the first game
    std::stop_token stop_;
    int ply_ = 0;  // moves of the game so far
    std::mutex mutex_;
    std::condition_variable_any changed_;
};

}  // namespace selfplay
