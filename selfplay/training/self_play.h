// Self-play alone: actors on threads of their own play with one network until enough games or
// positions are written to an archive or somebody asks for the end. Everything here is called from
// one thread, run() blocks. Equal settings, seeds and networks give equal games in an empty
// archive, in whatever order.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

#include "selfplay/records/segment.h"
#include "selfplay/training/actor.h"

namespace selfplay::training {

struct SelfPlaySettings {
    ActorSettings actors;
    int threads = 1;
    std::uint64_t seed = 1;
    // Bounds. So many games are begun, and all of them are finished; once so many positions are
    // written, games under way are dropped.
    std::optional<std::uint64_t> games, positions;
};

struct SelfPlayProgress {
    std::uint64_t games = 0, positions = 0, taught = 0, resigned = 0;  // written
    std::uint64_t evaluations = 0;
    double seconds = 0;
};

// Adds a game to what is written.
void count(const records::Game& game, SelfPlayProgress& progress);

// Of a run that writes to this archive: of the seed given, and of what the archive holds, so that a
// later run does not play the same games again. Fails when that is of another game.
std::uint64_t seed_for(const records::Archive& archive, std::string_view game, std::uint64_t seed);

template <engine::Encoded G>
class SelfPlay {
   public:
    using Source = typename Actor<G>::Source;
    using Report = std::function<void(const SelfPlayProgress&)>;

    // Fails with engine::Error as Actor does, and when the archive holds another game.
    SelfPlay(const SelfPlaySettings& settings, const Source& network, std::uint64_t steps,
             records::Archive& archive)
        : settings_(settings), archive_(archive) {
        const auto seed = seed_for(archive, G::name, settings.seed);
        for (int i = 0; i < settings.threads; ++i)
            actors_.push_back(std::make_unique<Actor<G>>(
                settings.actors, engine::mixed(seed, static_cast<std::uint64_t>(i)), network, steps,
                [this](records::Game game) { put(std::move(game)); }, share_of_games(i)));
    }

    // Reports a few times a second. Rethrows what stopped an actor or the archive; what was written
    // stays.
    SelfPlayProgress run(const std::stop_token& stop, const Report& report) {
        const auto start = std::chrono::steady_clock::now();
        working_ = actors_.size();
        std::vector<std::jthread> threads;
        for (const auto& actor : actors_) threads.emplace_back([this, &actor] { work(*actor); });
        const End end{ending_};  // however this ends, so do the threads
        bool over = false;
        do {
            over = !wait() || stop.stop_requested() || enough();
            if (over) ending_ = true, threads.clear();
            write();
            const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
            progress_.seconds = took.count();
            report(progress_);
        } while (!over);
        if (error_) std::rethrow_exception(error_);
        return progress_;
    }

   private:
    struct End {
        std::atomic<bool>& ending;
        ~End() { ending = true; }
    };

    std::uint64_t share_of_games(int actor) const {
        if (!settings_.games) return Actor<G>::endless;
        const auto threads = static_cast<std::uint64_t>(settings_.threads);
        return *settings_.games / threads +
               (static_cast<std::uint64_t>(actor) < *settings_.games % threads);
    }

    void work(Actor<G>& actor) {
        std::exception_ptr error;
        try {
            while (!ending_.load(std::memory_order_relaxed) && actor.advance()) {
            }
        } catch (...) {
            error = std::current_exception();
        }
        const std::lock_guard lock(mutex_);
        if (error) error_ = error, ending_ = true;
        --working_;
        changed_.notify_one();
    }

    void put(records::Game game) {
        const std::lock_guard lock(mutex_);
        games_.push_back(std::move(game));
    }

    // Whether actors are still at work.
    bool wait() {
        constexpr std::chrono::milliseconds step{250};
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, step, [&] { return working_ == 0; });
        return working_ > 0;
    }

    bool enough() const {
        return settings_.positions && progress_.positions >= *settings_.positions;
    }

    void write() {
        std::vector<records::Game> games;
        {
            const std::lock_guard lock(mutex_);
            games.swap(games_);
        }
        archive_.append(games);
        for (const auto& game : games) count(game, progress_);
        progress_.evaluations = 0;
        for (const auto& actor : actors_) progress_.evaluations += actor->counts().evaluations;
    }

    SelfPlaySettings settings_;
    records::Archive& archive_;
    std::vector<std::unique_ptr<Actor<G>>> actors_;
    SelfPlayProgress progress_;
    std::atomic<bool> ending_ = false;

    std::mutex mutex_;
    std::condition_variable changed_;
    std::size_t working_ = 0;
    std::vector<records::Game> games_;
    std::exception_ptr error_;
};

}  // namespace selfplay::training
