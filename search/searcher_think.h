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
        begin_tree(limits);
    }
    const std::lock_guard lock(mutex_);
    begin_team(limits);
    interrupted_ = ended_ = false;
    if (!limits.ponder) take_effect(limits);
}

// With picture_mutex_ held.
template <engine::Game G>
void Searcher<G>::begin_tree(const Limits& limits) {
    MoveFilter filter;
    filter.restrict(limits.only, limits.avoid);
    // What stronger thinks have found is not for a weak one.
    if (limits_strength(limits)) search_->set_root(G(position()));
    search_->favour(position().to_play());
    search_->restrict_root(filter, limits.only);
    for (const auto& worker : workers_) worker->reset_counts();
    unanswered_->clear();
    started_ = Clock::now();
    fault_.clear();
    elapsed_.reset();
    chosen_.reset();
}

// With mutex_ held.
template <engine::Game G>
void Searcher<G>::begin_team(const Limits& limits) {
    limits_ = limits;
    if (limits_strength(limits)) {
        const auto most = simulations_of_level(params_.level);
        limits_.simulations = std::min(limits.simulations.value_or(most), most);
    }
    team_ = std::make_unique<Team>();
    team_->early_end = params_.early_end && !uses_gumbel() && !limits_strength(limits);
    if (uses_network()) team_->check_every = 16;
    team_->batch = batch();
    team_->meets_at_root = uses_gumbel() || params_.noise > 0;
    schedule_.reset();
    const auto now = standing(search_->tree(), search_->filter());
    previous_value_.reset();
    if (now.first_visits > 0) previous_value_ = now.value;
    working_ = workers_.size();
    if (search_->tree()[search_->tree().root()].expanded()) prepare_root();
}

// Of an expanded root, with no descent under way: the noise of its priors, and Gumbel's choice.
template <engine::Game G>
void Searcher<G>::prepare_root() {
    const auto edges = search_->tree().edges(search_->tree().root());
    if (params_.noise > 0 && !noisy_ && !edges.empty()) {
        search_->mix_root_noise(random_, params_.noise, params_.noise_alpha);
        noisy_ = true;
    }
    const auto& filter = search_->filter();
    const bool choosable = std::any_of(edges.begin(), edges.end(),
                                       [&](const Edge& edge) { return filter(edge.move); });
    if (!uses_gumbel() || team_->gumbel || !choosable) return;
    const GumbelParams gumbel{params_.gumbel_moves, params_.gumbel_visits, params_.gumbel_scale,
                              params_.gumbel_noise};
    team_->gumbel.emplace(search_->tree(), filter, limits_.simulations, gumbel, random_);
}

// What workers meet for.
template <engine::Game G>
void Searcher<G>::meet() {
    const std::lock_guard lock(picture_mutex_);
    if (team_->full.exchange(false)) {
        unanswered_->clear();
        search_->flip();
    }
    if (team_->meets_at_root && search_->tree()[search_->tree().root()].expanded()) prepare_root();
}

// With mutex_ held.
template <engine::Game G>
void Searcher<G>::take_effect(const Limits& limits) {
    effective_ = Clock::now();
    overslept_ /= 2;
    schedule_.emplace(limits, params_, moves_to_come(position()), lag());
    if (limits_.simulations) team_->limit = std::max<std::uint64_t>(*limits_.simulations, 1);
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
    try {
        worker.work(*search_, *team_, [this] { meet(); });
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
        const auto planned = next_event(next_report);
        if (changed_.wait_until(lock, planned) == std::cv_status::timeout)
            overslept_ = std::max(overslept_, since(planned));
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
        choose();
    }
    if (done) done(analysis());
    lock.lock();
    // Against the deadline where one was missed, else against the decision to end.
    const auto due = hard ? std::min(asked, effective_ + *hard) : asked;
    late_.record(since(due));
    ended_ = true;
    changed_.notify_all();
}

// With picture_mutex_ held: the move to play, where it need not be the best.
template <engine::Game G>
void Searcher<G>::choose() {
    const auto now = standing(search_->tree(), search_->filter());
    if (limits_strength(limits_)) {
        chosen_ = draw_move(temperature_of_level(params_.level));
    } else if (now.decided || now.moves == 0 || !plays(limits_)) {
        return;
    } else if (params_.temperature > 0 &&
               (params_.temperature_plies == 0 || limits_.ply < params_.temperature_plies)) {
        chosen_ = draw_move(params_.temperature);
    } else if (team_->gumbel) {
        chosen_ = team_->gumbel->best();
    }
}

template <engine::Game G>
std::optional<Move> Searcher<G>::draw_move(float temperature) {
    auto best_first = telling(0x7fffffff, 1);
    best_first.by_bound = false;
    const auto moves = describe_moves(search_->tree(), search_->filter(), best_first);
    if (moves.empty()) return std::nullopt;
    std::vector<std::uint64_t> counts;
    counts.reserve(moves.size());
    for (const auto& move : moves) counts.push_back(move.visits);
    return moves[draw_by_count(counts, temperature, random_)].move;
}

// With mutex_ held: when to look again at the latest.
template <engine::Game G>
TimePoint Searcher<G>::next_event(TimePoint next_report) const {
    constexpr Milliseconds step{10}, long_time{1000000};
    const auto now = Clock::now();
    const auto last = last_moment();
    const auto check = last ? std::min(effective_ + *last, now + step) : now + long_time;
    return std::min(next_report, check);
}

// With mutex_ held: when to end at the latest. On a machine so busy that the conductor is woken
// late, earlier than the schedule says if the clock would not bear it.
template <engine::Game G>
std::optional<Milliseconds> Searcher<G>::last_moment() const {
    if (!schedule_ || !schedule_->hard()) return {};
    if (!limits_.clock || limits_.clock->control.unlimited) return schedule_->hard();
    const auto borne = limits_.clock->longest_move() - LagMeter::reserve_for(overslept_);
    return std::min(*schedule_->hard(), std::max(borne, Milliseconds(1)));
}

// With mutex_ held.
template <engine::Game G>
bool Searcher<G>::over() {
    if (interrupted_) return true;
    // All may have left because the root has nothing to search; an endless think goes on waiting.
    if (!schedule_) return false;
    if (working_ == 0 && !limits_.endless()) return true;
    if (const auto last = last_moment(); last && since(effective_) >= *last) return true;
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
