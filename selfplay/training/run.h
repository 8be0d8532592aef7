// A run from random weights (or from where it was stopped) on: actors play, their games are
// recorded and sampled, the student learns, its weights go to the actors. Self-play and learning
// take turns on all cores, which keeps the learner's share of them exact. All that a run knows is
// in its folder; whatever ends it costs at most the games in flight. One owner, one thread; run()
// blocks.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/games.h"
#include "nn/load.h"
#include "search/calibrate.h"
#include "search/network_evaluator.h"
#include "selfplay/records/segment.h"
#include "selfplay/training/crew.h"
#include "selfplay/training/journal.h"
#include "selfplay/training/ladder.h"
#include "selfplay/training/progress.h"
#include "selfplay/training/replay.h"
#include "selfplay/training/report.h"
#include "selfplay/training/settings.h"
#include "selfplay/training/student.h"

namespace selfplay::training {

template <engine::Encoded G>
class Run {
   public:
    // Makes the folder or goes on from it; a new one begins with the weights of the file `from`,
    // or, where that is empty, with random ones. Fails with engine::Error when it is not a run of
    // these settings, or is in use.
    Run(const std::filesystem::path& folder, const Settings& settings,
        const std::filesystem::path& from, int threads, const Bounds& bounds, Say say);

    // Until a bound is reached or a stop is requested. Fails with engine::Error when the disk takes
    // no more or learning cannot go on; what was played before is safe.
    void run(const std::stop_token& stop);

   private:
    using Clock = std::chrono::steady_clock;
    using Source = typename Crew<G>::Source;

    G first_game() const { return largest_position<G>(settings_.actors); }
    nn::Graph first_network(const std::filesystem::path& from) const {
        auto fresh = new_network(settings_.network, first_game(),
                                 static_cast<std::uint64_t>(settings_.run.seed));
        return from.empty() ? fresh : network_like(fresh, from);
    }
    void fill_replay();

    bool rolls_out() const {
        return state_.games < static_cast<std::uint64_t>(settings_.run.rollout_games);
    }
    Source published_network();
    Source playing(const nn::Graph& graph, const nn::Calibration& calibration) const {
        return std::make_shared<search::NetworkSource<G>>(
            std::make_shared<const search::Network>(graph, settings_.run.precision, calibration));
    }
    nn::Calibration calibrate(const nn::Graph& graph);
    std::vector<G> random_positions(int count);

    void play(const std::stop_token& stop);
    void record(std::vector<records::Game> games);
    void learn(const std::stop_token& stop);
    void publish(const std::stop_token& stop);
    bool passes_gate(const nn::Graph& graph, const nn::Calibration& calibration,
                     const std::stop_token& stop);
    void measure(const std::stop_token& stop);
    void write_report();
    Quality held_out_quality();
    void set_simulations();

    static double since(Clock::time_point start) {
        return std::chrono::duration<double>(Clock::now() - start).count();
    }
    bool over(const std::stop_token& stop) const;
    Standing standing() const;
    bool may_learn() const {
        return state_.games >= static_cast<std::uint64_t>(settings_.run.first_games) &&
               replay_.lessons().positions() > 0;
    }
    double samples_due() const {
        return double{settings_.run.ratio} * static_cast<double>(new_positions_) -
               static_cast<double>(samples_) - forgiven_;
    }

    RunFolder folder_;
    Settings settings_;
    Bounds bounds_;
    Say say_;
    records::Archive archive_;
    Journal journal_;
    Replay<G> replay_;
    Student student_;
    engine::Random random_;
    Progress progress_;
    int threads_;
    Ladder ladder_;
    std::unique_ptr<Crew<G>> crew_;

    Clock::time_point started_ = Clock::now();
    RunState state_;  // seconds: of earlier calls
    // Of this call.
    std::uint64_t new_positions_ = 0, samples_ = 0;
    double forgiven_ = 0;  // samples
    double learn_seconds_ = 0;
    double owed_play_ = 0;  // seconds that the actors are to have before the learner is next
    int burst_ = 1;         // steps that the learner takes in one turn
    double measure_seconds_ = 0;
    double reported_ = -1;  // second of the run
    bool measures_ = true;
    std::int64_t published_ = 0;  // step
};

template <engine::Encoded G>
Run<G>::Run(const std::filesystem::path& folder, const Settings& settings,
            const std::filesystem::path& from, int threads, const Bounds& bounds, Say say)
    : folder_(folder),
      settings_(settings),
      bounds_(bounds),
      say_(std::move(say)),
      archive_(folder_.games()),
      journal_(folder_.metrics()),
      replay_(settings.replay, settings.network.encoding_name(), threads),
      student_(first_network(from), settings.learn, threads, folder_, say_),
      random_(engine::mixed(static_cast<std::uint64_t>(settings.run.seed),
                            static_cast<std::uint64_t>(student_.steps()))),
      progress_(bounds),
      threads_(threads),
      ladder_(folder_, settings, threads),
      state_(folder_.state()),
      published_(student_.steps()) {
    keep_settings(folder, settings);
    if (!archive_.damage().empty()) say_(archive_.damage());
    fill_replay();
}

// From the newest segment back until the window is full; then the games in their order.
template <engine::Encoded G>
void Run<G>::fill_replay() {
    const auto paths = archive_.segments();
    std::deque<std::vector<records::Game>> parts;
    std::uint64_t games = 0;
    for (std::size_t i = paths.size(); i-- > 0;) {
        if (games > window_of(settings_.replay, std::max(state_.games, games))) break;
        auto segment = records::unpack(engine::read_file(paths[i]));
        if (!segment.damage.empty())
            say_(fmt::format("{}: {}; left out", paths[i].string(), segment.damage));
        games += segment.games.size();
        parts.push_front(std::move(segment.games));
    }
    state_.games = std::max(state_.games, games);
    GameTally tally;
    std::size_t refused = 0;
    for (auto& part : parts)
        for (auto& game : part) {
            tally.add(game);
            if (!replay_.add(std::move(game), state_.games)) ++refused;
        }
    state_.positions = std::max(state_.positions, tally.taught);
    if (games > 0)
        say_(fmt::format("{} games so far, {} to learn from; {} steps", state_.games,
                         replay_.games(), student_.steps()));
    if (refused > 0) say_(fmt::format("{} games of the archive teach nothing", refused));
}

template <engine::Encoded G>
bool Run<G>::over(const std::stop_token& stop) const {
    return stop.stop_requested() || (bounds_.minutes && since(started_) >= *bounds_.minutes * 60) ||
           (bounds_.games && state_.games >= *bounds_.games);
}

template <engine::Encoded G>
Standing Run<G>::standing() const {
    auto state = state_;
    state.seconds += since(started_);
    return {state,           crew_->counts().evaluations, samples_, new_positions_, learn_seconds_,
            student_.steps()};
}

template <engine::Encoded G>
void Run<G>::run(const std::stop_token& stop) {
    const auto network = published_network();
    crew_ = std::make_unique<Crew<G>>(settings_.actors, threads_, random_(),
                                      rolls_out() ? nullptr : network,
                                      static_cast<std::uint64_t>(student_.steps()));
    set_simulations();
    progress_.begin(standing());
    while (!over(stop)) {
        play(stop);
        // After the last games as well: they were asked for to be learned from.
        if (!stop.stop_requested() && may_learn()) learn(stop);
        if (!over(stop)) measure(stop);
        const double seconds = standing().state.seconds;
        if (reported_ < 0 || seconds >= reported_ + 60.0 * settings_.run.report_minutes)
            write_report();
    }
    if (student_.steps() > published_) publish(stop);
    folder_.keep(standing().state);
    write_report();
}

// Until enough positions are new and the actors have had their share of the time.
template <engine::Encoded G>
void Run<G>::play(const std::stop_token& stop) {
    const auto begun = Clock::now();
    const double wanted = double{1} * burst_ * settings_.learn.batch;
    const auto enough = [&] {
        return since(begun) >= owed_play_ && samples_due() >= wanted && may_learn();
    };
    crew_->run();
    while (!over(stop) && !enough()) {
        // Games that end about the same time share a frame, and the disk's time.
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        record(crew_->take(std::chrono::milliseconds(50)));
        if (const auto line = progress_.due(standing())) say_(*line);
    }
    crew_->pause();
    record(crew_->take(std::chrono::milliseconds(0)));
}

template <engine::Encoded G>
void Run<G>::record(std::vector<records::Game> games) {
    if (games.empty()) return;
    archive_.append(games);
    archive_.keep(static_cast<std::uint64_t>(settings_.run.keep_mib) << 20);
    for (auto& game : games) {
        GameTally tally;
        tally.add(game);
        progress_.add(game);
        ++state_.games;
        state_.positions += tally.taught;
        new_positions_ += tally.taught;
        replay_.add(std::move(game), state_.games);
    }
    folder_.keep(standing().state);
}

template <engine::Encoded G>
void Run<G>::learn(const std::stop_token& stop) {
    const auto begun = Clock::now();
    for (int i = 0; i < burst_ && !stop.stop_requested(); ++i) {
        student_.learn(replay_.draw(settings_.learn.batch, student_.terms(), random_));
        samples_ += static_cast<std::uint64_t>(settings_.learn.batch);
    }
    // What the learner had no time for is forgiven, so that the debt does not grow without end.
    const double most = 4.0 * burst_ * settings_.learn.batch;
    forgiven_ += std::max(0.0, samples_due() - most);
    // Turns of about a second: pausing the actors costs little then, and weights stay fresh.
    if (since(begun) < 0.5) burst_ = std::min(2 * burst_, settings_.run.refresh);
    if (since(begun) > 2) burst_ = std::max(1, burst_ / 2);
    if (student_.steps() >= published_ + settings_.run.refresh) publish(stop);
    const double seconds = since(begun), share = double{settings_.run.learner_share};
    learn_seconds_ += seconds;
    owed_play_ = seconds * (1 - share) / share;
}

}  // namespace selfplay::training

#include "selfplay/training/run_publish.h"

namespace selfplay::training {

// Each compiled once, in a file of its own.
extern template class Run<go::Go>;
extern template class Run<chess::Chess>;
extern template class Run<shogi::Shogi>;

}  // namespace selfplay::training
