// The search that a protocol talks to: a tree, workers on their own threads, and the limits
// of a think. One owner calls everything here from one thread; only the callbacks come from
// another.
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/game.h"
#include "search/analysis.h"
#include "search/clock.h"
#include "search/crew.h"
#include "search/limits.h"
#include "search/params.h"
#include "search/tree_search.h"
#include "search/worker.h"

namespace search {

template <engine::Game G>
class Searcher {
   public:
    using Report = std::function<void(const Analysis&)>;

    // Fails with engine::Error when the system grants no memory for the tree.
    explicit Searcher(const SearchParams& params) { rebuild(params); }
    Searcher(const Searcher&) = delete;
    Searcher& operator=(const Searcher&) = delete;
    ~Searcher() { stop(); }

    // A changed memory budget forgets the tree; changed threads or seed start new workers.
    void set_params(const SearchParams& params);
    const SearchParams& params() const { return params_; }

    const G& position() const { return search_->root(); }
    // The position to think about. Keeps the part of the tree that the position shares when it
    // comes after the present one by at most two moves of the tree; else starts anew.
    void set_position(const G& root);
    // Plays a legal move in the present position and keeps what the tree has below it.
    void advance(Move move);
    // Forgets the tree and starts the random numbers anew: what follows is as in a new Searcher.
    void clear();

    // Returns at once. `report` and `done` (either may be empty) are called from a thread of the
    // search; `done` exactly once a think, after which the search is idle. While it runs only
    // stop(), interrupt(), ponder_hit(), thinking() and analysis() may be called; a callback may
    // call no others, and not stop().
    void start(const Limits& limits, Report report, Report done);
    // Ends the think within 5 ms (once every root move is known, however few its visits) and
    // returns when `done` has returned.
    void stop();
    // Returns when the think is over by itself and `done` has returned.
    void wait() const;
    // Asks for the end and returns at once; from any thread.
    void interrupt();
    void ponder_hit();
    bool thinking() const;

    // A consistent picture, at any time, from any thread; the last think's when idle.
    Analysis analysis(int most_moves = 0x7fffffff, int variation_length = 32) const;

    // start, wait for the end, return the picture. For callers without a protocol.
    Analysis think(const Limits& limits);

    // What the next clocked think will keep back.
    Milliseconds lag() const { return Milliseconds(params_.lag_ms) + late_.reserve(); }

   private:
    using Clock = std::chrono::steady_clock;

    void rebuild(const SearchParams& params);
    void hire();
    void reset_tallies();
    void begin(const Limits& limits);
    void take_effect(const Limits& limits);
    void run(int index, const Report& report, const Report& done);
    void work(Worker<G>& worker);
    void conduct(const Report& report, const Report& done);
    TimePoint next_event(TimePoint next_report) const;
    bool over() const;
    void add_owners(Analysis& picture) const;
    static Milliseconds since(TimePoint start) {
        return std::chrono::duration_cast<Milliseconds>(Clock::now() - start);
    }

    SearchParams params_;
    std::unique_ptr<TreeSearch<G>> search_;
    std::vector<std::unique_ptr<Worker<G>>> workers_;
    LagMeter late_;

    // Readers of the tree against whoever moves its parts; never taken in a simulation.
    mutable std::mutex picture_mutex_;
    TimePoint started_{};
    std::string fault_;
    std::optional<Milliseconds> elapsed_;  // once the think is over

    // The conductor of a think against its owner and workers.
    mutable std::mutex mutex_;
    mutable std::condition_variable changed_;
    Limits limits_;
    std::optional<Schedule> schedule_;  // once the limits have taken effect
    TimePoint effective_{};
    std::optional<float> previous_value_;
    std::size_t working_ = 0;
    bool interrupted_ = false;
    bool ended_ = true;  // `done` has returned

    std::unique_ptr<Team> team_ = std::make_unique<Team>();
    std::unique_ptr<Crew> crew_;  // the workers, then the conductor; last, to end first
};

template <engine::Game G>
void Searcher<G>::rebuild(const SearchParams& params) {
    params_ = params;
    const std::lock_guard lock(picture_mutex_);
    search_.reset();
    search_ = std::make_unique<TreeSearch<G>>(params);
    hire();
}

template <engine::Game G>
void Searcher<G>::hire() {
    crew_.reset();
    workers_.clear();
    for (int i = 0; i < params_.threads; ++i) {
        const auto seed = static_cast<std::uint64_t>(params_.seed) << 32 | static_cast<unsigned>(i);
        workers_.push_back(std::make_unique<Worker<G>>(std::make_unique<RolloutLeaf<G>>(seed)));
    }
    crew_ = std::make_unique<Crew>(params_.threads + 1);
}

template <engine::Game G>
void Searcher<G>::set_params(const SearchParams& params) {
    crew_->wait();
    const auto old = std::exchange(params_, params);
    if (old.memory_mib != params.memory_mib) {
        const G root = position();
        rebuild(params);
        return set_position(root);
    }
    const std::lock_guard lock(picture_mutex_);
    search_->set_params(params);
    if (old.threads != params.threads || old.seed != params.seed) hire();
}

template <engine::Game G>
void Searcher<G>::set_position(const G& root) {
    crew_->wait();
    const std::lock_guard lock(picture_mutex_);
    if (root == position()) return;
    reset_tallies();
    const auto line = search_->line_to(root);
    if (line.empty()) return search_->set_root(root);
    for (const Move move : line) search_->advance(move);
}

template <engine::Game G>
void Searcher<G>::advance(Move move) {
    crew_->wait();
    const std::lock_guard lock(picture_mutex_);
    search_->advance(move);
    reset_tallies();
}

template <engine::Game G>
void Searcher<G>::clear() {
    crew_->wait();
    const std::lock_guard lock(picture_mutex_);
    search_->set_root(G(position()));
    hire();
}

template <engine::Game G>
void Searcher<G>::reset_tallies() {
    for (const auto& worker : workers_)
        if (auto* tally = worker->tally()) tally->reset();
}

template <engine::Game G>
void Searcher<G>::start(const Limits& limits, Report report, Report done) {
    crew_->wait();
    begin(limits);
    crew_->start([this, report = std::move(report), done = std::move(done)](int index) {
        run(index, report, done);
    });
}

template <engine::Game G>
void Searcher<G>::begin(const Limits& limits) {
    {
        const std::lock_guard lock(picture_mutex_);
        MoveFilter filter;
        filter.restrict(limits.only, limits.avoid);
        search_->restrict_root(filter, limits.only);
        for (const auto& worker : workers_) worker->reset_counts();
        started_ = Clock::now();
        fault_.clear();
        elapsed_.reset();
    }
    const std::lock_guard lock(mutex_);
    limits_ = limits;
    team_ = std::make_unique<Team>();
    team_->early_end = params_.early_end;
    schedule_.reset();
    const auto now = standing(search_->tree(), search_->filter());
    previous_value_.reset();
    if (now.first_visits > 0) previous_value_ = now.value;
    working_ = workers_.size();
    interrupted_ = ended_ = false;
    if (!limits.ponder) take_effect(limits);
}

// With mutex_ held.
template <engine::Game G>
void Searcher<G>::take_effect(const Limits& limits) {
    effective_ = Clock::now();
    schedule_.emplace(limits, params_, moves_to_come(position()), lag());
    if (limits.simulations) team_->limit = std::max<std::uint64_t>(*limits.simulations, 1);
}

template <engine::Game G>
void Searcher<G>::stop() {
    interrupt();
    wait();
}

template <engine::Game G>
void Searcher<G>::wait() const {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return ended_; });
}

template <engine::Game G>
bool Searcher<G>::thinking() const {
    const std::lock_guard lock(mutex_);
    return !ended_;
}

template <engine::Game G>
void Searcher<G>::interrupt() {
    const std::lock_guard lock(mutex_);
    interrupted_ = true;
    team_->stop = true;
    changed_.notify_all();
}

template <engine::Game G>
void Searcher<G>::ponder_hit() {
    const std::lock_guard lock(mutex_);
    if (!schedule_) take_effect(limits_);
    changed_.notify_all();
}

template <engine::Game G>
void Searcher<G>::run(int index, const Report& report, const Report& done) {
    const auto worker = static_cast<std::size_t>(index);
    if (worker == workers_.size()) return conduct(report, done);
    work(*workers_[worker]);
    const std::lock_guard lock(mutex_);
    --working_;
    changed_.notify_all();
}

template <engine::Game G>
void Searcher<G>::work(Worker<G>& worker) {
    const auto flip = [this] {
        const std::lock_guard lock(picture_mutex_);
        search_->flip();
    };
    try {
        worker.work(*search_, *team_, flip);
    } catch (const std::exception& error) {
        {
            const std::lock_guard lock(picture_mutex_);
            if (fault_.empty()) fault_ = error.what();
        }
        interrupt();
    }
}

// Watches over the think on a thread of its own, so that no rollout, however long, delays the
// clock.
template <engine::Game G>
void Searcher<G>::conduct(const Report& report, const Report& done) {
    std::unique_lock lock(mutex_);
    const auto every = limits_.report_every;
    TimePoint next_report = every ? Clock::now() + *every : TimePoint::max();
    while (!over()) {
        changed_.wait_until(lock, next_event(next_report));
        if (Clock::now() < next_report || over()) continue;
        next_report = Clock::now() + *every;
        lock.unlock();
        if (report) report(analysis());
        lock.lock();
    }
    const auto asked = Clock::now();
    const auto hard = schedule_ ? schedule_->hard() : std::nullopt;
    team_->stop = true;
    // A worker that a busy machine does not let run must not hold up the answer.
    constexpr Milliseconds patience{2};
    const auto all_left = [&] { return working_ == 0; };
    changed_.wait_for(lock, patience, all_left);
    if (!search_->tree()[search_->tree().root()].expanded()) changed_.wait(lock, all_left);
    lock.unlock();
    {
        const std::lock_guard picture(picture_mutex_);
        elapsed_ = since(started_);
    }
    if (done) done(analysis());
    lock.lock();
    // Against the deadline where one was missed, else against the decision to end.
    const auto due = hard ? std::min(asked, effective_ + *hard) : asked;
    late_.record(since(due));
    ended_ = true;
    changed_.notify_all();
}

// With mutex_ held: when to look again at the latest.
template <engine::Game G>
TimePoint Searcher<G>::next_event(TimePoint next_report) const {
    constexpr Milliseconds step{10}, long_time{1000000};
    const auto now = Clock::now();
    const bool timed = schedule_ && schedule_->hard();
    const auto check =
        timed ? std::min(effective_ + *schedule_->hard(), now + step) : now + long_time;
    return std::min(next_report, check);
}

// With mutex_ held.
template <engine::Game G>
bool Searcher<G>::over() const {
    if (interrupted_) return true;
    // All may have left because the root has nothing to search; an endless think goes on waiting.
    if (!schedule_) return false;
    if (working_ == 0 && !limits_.endless()) return true;
    std::uint64_t simulations = 0;
    for (const auto& worker : workers_) simulations += worker->simulations();
    const std::lock_guard picture(picture_mutex_);
    return schedule_->over(since(effective_), simulations,
                           standing(search_->tree(), search_->filter()), previous_value_);
}

template <engine::Game G>
Analysis Searcher<G>::analysis(int most_moves, int variation_length) const {
    const std::lock_guard lock(picture_mutex_);
    const Tree& tree = search_->tree();
    const Node& root = tree[tree.root()];
    Analysis picture;
    picture.visits = root.visits;
    picture.value = -root.mean();
    picture.elapsed = elapsed_.value_or(since(started_));
    std::uint64_t steps = 0, deepest = 0;
    for (const auto& worker : workers_) {
        picture.simulations += worker->simulations();
        steps += worker->steps();
        deepest = std::max(deepest, worker->deepest());
    }
    picture.depth = picture.simulations ? static_cast<int>(steps / picture.simulations) : 0;
    picture.deepest = static_cast<int>(deepest);
    picture.memory_used = static_cast<float>(tree.share_used());
    picture.moves = describe_moves(tree, search_->filter(), most_moves, variation_length);
    picture.fault = fault_;
    add_owners(picture);
    return picture;
}

template <engine::Game G>
void Searcher<G>::add_owners(Analysis& picture) const {
    OwnerTally::Sum sum;
    for (const auto& worker : workers_)
        if (const auto* tally = worker->tally()) tally->add_to(sum);
    if (sum.rollouts == 0) return;
    const double sign = position().to_play() == engine::Player::first ? 1 : -1;
    const double scale = sign / static_cast<double>(sum.rollouts);
    picture.lead = static_cast<float>(scale * sum.lead);
    picture.draws = static_cast<float>(sum.draws) / static_cast<float>(sum.rollouts);
    for (const double owner : sum.owners)
        picture.owners.push_back(static_cast<float>(scale * owner));
}

template <engine::Game G>
Analysis Searcher<G>::think(const Limits& limits) {
    Analysis last;
    start(limits, {}, [&](const Analysis& picture) { last = picture; });
    crew_->wait();
    return last;
}

}  // namespace search
