// The actors of a run, each on a thread of its own: they play while the crew runs, stand still
// while it is paused, and put every finished game into one queue. One owner calls everything here
// from one thread.
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "selfplay/training/actor.h"

namespace selfplay::training {

template <engine::Encoded G>
class Crew {
   public:
    using Source = typename Actor<G>::Source;

    // Paused. Fails with engine::Error as an actor's start does.
    Crew(const ActorSettings& settings, int threads, std::uint64_t seed, Source network,
         std::uint64_t steps) {
        for (int i = 0; i < threads; ++i)
            actors_.push_back(std::make_unique<Actor<G>>(
                settings, engine::mixed(seed, static_cast<std::uint64_t>(i)), network, steps,
                [this](records::Game game) { put(std::move(game)); }));
        for (auto& actor : actors_) threads_.emplace_back([this, &actor] { work(*actor); });
    }
    Crew(const Crew&) = delete;
    Crew& operator=(const Crew&) = delete;
    ~Crew() {
        {
            const std::lock_guard lock(mutex_);
            over_ = true;
        }
        changed_.notify_all();
        for (auto& thread : threads_) thread.join();
    }

    void run() {
        const std::lock_guard lock(mutex_);
        running_ = true;
        changed_.notify_all();
    }
    // Returns when all stand still: within one answer of the network.
    void pause() {
        std::unique_lock lock(mutex_);
        running_ = false;
        still_.wait(lock, [&] { return busy_ == 0; });
    }

    // While paused.
    void set_network(const Source& network, std::uint64_t steps) {
        for (auto& actor : actors_) actor->set_network(network, steps);
    }
    void set_simulations(int full, int fast) {
        for (auto& actor : actors_) actor->set_simulations(full, fast);
    }
    int simulations() const { return actors_.front()->simulations(); }  // of a full search
    // The highest of the actors', each of which watches its own games.
    float resign_threshold() const {
        float highest = -1;
        for (const auto& actor : actors_)
            highest = std::max(highest, actor->resignation().threshold());
        return highest;
    }

    // The games finished since the last call; waits for the first one at most so long. Rethrows
    // what stopped an actor.
    std::vector<records::Game> take(std::chrono::milliseconds longest) {
        std::unique_lock lock(mutex_);
        arrived_.wait_for(lock, longest, [&] { return !games_.empty() || error_; });
        if (error_) std::rethrow_exception(error_);
        return std::exchange(games_, {});
    }

    ActorCounts counts() const {
        ActorCounts sum;
        for (const auto& actor : actors_) {
            const auto counts = actor->counts();
            sum.evaluations += counts.evaluations;
            sum.games += counts.games;
            sum.positions += counts.positions;
            sum.taught += counts.taught;
            sum.resigned += counts.resigned;
        }
        return sum;
    }

   private:
    void put(records::Game game) {
        const std::lock_guard lock(mutex_);
        games_.push_back(std::move(game));
        arrived_.notify_one();
    }

    // Waits until the crew runs; false when it is over.
    bool begin() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return running_ || over_; });
        if (!over_) ++busy_;
        return !over_;
    }
    void end() {
        const std::lock_guard lock(mutex_);
        --busy_;
        still_.notify_one();
    }
    bool runs() const {
        const std::lock_guard lock(mutex_);
        return running_ && !over_;
    }

    void work(Actor<G>& actor) {
        while (begin()) {
            try {
                while (runs()) actor.advance();
            } catch (...) {
                const std::lock_guard lock(mutex_);
                error_ = std::current_exception();
                running_ = false;
                arrived_.notify_one();
            }
            end();
        }
    }

    mutable std::mutex mutex_;
    std::condition_variable changed_, still_, arrived_;
    bool running_ = false, over_ = false;
    int busy_ = 0;
    std::vector<records::Game> games_;
    std::exception_ptr error_;
    std::vector<std::unique_ptr<Actor<G>>> actors_;
    std::vector<std::thread> threads_;  // last, to end first
};

}  // namespace selfplay::training
