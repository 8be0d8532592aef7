// How a Searcher thinks: the definitions of its members that start, watch over and end a think.
// Included by search/searcher.h, and by nothing else.
#pragma once

#include "search/searcher.h"

namespace search {

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
Analysis Searcher<G>::think(const Limits& limits) {
    Analysis last;
    start(limits, {}, [&](const Analysis& picture) { last = picture; });
    crew_->wait();
    return last;
}

}  // namespace search
