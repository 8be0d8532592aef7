// What a run does between two turns of learning: gives the new network to the actors, measures it,
// and writes its report. Part of Run; included by run.h alone.
#pragma once

#include "selfplay/training/run.h"

namespace selfplay::training {

// The network that self-play uses, from its file or, where there is none, from the student.
template <engine::Encoded G>
typename Run<G>::Source Run<G>::published_network() {
    if (std::filesystem::exists(folder_.latest())) try {
            const auto latest = nn::load_contents(folder_.latest());
            return playing(latest.graph, latest.calibration.maxima.empty() ? calibrate(latest.graph)
                                                                           : latest.calibration);
        } catch (const engine::Error& error) {
            say_(fmt::format("{}; written anew", error.what()));
        }
    const auto graph = student_.newest();
    const auto calibration = calibrate(graph);
    nn::save(graph, folder_.latest(), calibration);
    return playing(graph, calibration);
}

// On positions of the replay window, which are what self-play meets.
template <engine::Encoded G>
nn::Calibration Run<G>::calibrate(const nn::Graph& graph) {
    constexpr int count = 128;
    const auto positions = replay_.lessons().positions() > 0 ? replay_.positions(count, random_)
                                                             : random_positions(count);
    return search::calibrate<G>(graph, positions);
}

// For as long as nothing has been played.
template <engine::Encoded G>
std::vector<G> Run<G>::random_positions(int count) {
    std::vector<G> positions;
    while (positions.size() < static_cast<std::size_t>(count)) {
        G game = positions.empty() ? first_game() : positions.back();
        if (game.outcome() != engine::Outcome::ongoing) game = first_game();
        const auto moves = game.legal_moves();
        game.play(moves[random_.below(moves.size())]);
        positions.push_back(std::move(game));
    }
    return positions;
}

template <engine::Encoded G>
void Run<G>::publish(const std::stop_token& stop) {
    constexpr int norm_samples = 1024;
    student_.save();
    published_ = student_.steps();
    const auto graph = student_.playable(replay_.draw(norm_samples, student_.terms(), random_));
    const auto calibration = calibrate(graph);
    if (!settings_.run.gate || passes_gate(graph, calibration, stop)) {
        nn::save(graph, folder_.latest(), calibration);
        if (!rolls_out())
            crew_->set_network(playing(graph, calibration),
                               static_cast<std::uint64_t>(student_.steps()));
    }
    set_simulations();
    auto entry = progress_.take_entry(standing());
    entry.learned = student_.take_quality();
    entry.held_out = held_out_quality();
    entry.window = replay_.games();
    entry.simulations = crew_->simulations();
    entry.resign_threshold = double{crew_->resign_threshold()};
    progress_.set_quality(entry.held_out);
    journal_.append(entry);
}

template <engine::Encoded G>
bool Run<G>::passes_gate(const nn::Graph& graph, const nn::Calibration& calibration,
                         const std::stop_token& stop) {
    nn::save(graph, folder_.candidate(), calibration);
    const auto verdict = judge(settings_, folder_.latest(), folder_.candidate(), threads_, stop);
    say_(fmt::format("gate: step {} scored {:.1f} % of {} games and {}", student_.steps(),
                     100 * verdict.tally.score(), verdict.tally.games(),
                     verdict.passed ? "takes over" : "does not take over"));
    return verdict.passed;
}

// A pair of games where measuring has had less than its share of the time. Learning waits for it,
// so it is not to take longer than all that share so far, but for a minute.
template <engine::Encoded G>
void Run<G>::measure(const std::stop_token& stop) {
    const double share = double{settings_.run.ladder_share};
    const double due = share * since(started_);
    if (!measures_ || share <= 0 || measure_seconds_ > due) return;
    const auto begun = Clock::now();
    try {
        const double seconds = standing().state.seconds;
        if (ladder_.wants_snapshot(seconds)) ladder_.keep(student_.steps(), seconds);
        ladder_.measure(stop, std::max(due, 60.0));
    } catch (const engine::Error& error) {
        say_(fmt::format("no more games to measure strength: {}", error.what()));
        measures_ = false;
    }
    measure_seconds_ += since(begun);
}

template <engine::Encoded G>
void Run<G>::write_report() {
    reported_ = standing().state.seconds;
    const auto* const game = replay_.lessons().newest();
    const ReportInput told{settings_, journal_.entries(), ladder_.rungs(),
                           game ? sample_of<G>(*game) : SampleGame{}};
    engine::write_file(folder_.report(), report_html(told));
    if (const auto curve = ladder_svg(told); !curve.empty())
        engine::write_file(folder_.curve(), curve);
}

template <engine::Encoded G>
Quality Run<G>::held_out_quality() {
    constexpr int samples = 1024;
    if (replay_.held_out().positions() == 0) return {};
    engine::Random random(1);  // so that two networks are asked about like positions
    QualityTally tally;
    const auto& drawn = replay_.draw_held_out(samples, student_.terms(), random);
    tally.add(student_.judge(drawn), student_.terms(), samples);
    return tally.mean();
}

// Along a straight line over the games played, once the network judges them.
template <engine::Encoded G>
void Run<G>::set_simulations() {
    const auto& run = settings_.run;
    const auto& actors = settings_.actors;
    if (rolls_out())
        return crew_->set_simulations(run.rollout_simulations, run.rollout_simulations);
    if (run.last_simulations == 0)
        return crew_->set_simulations(actors.simulations, actors.fast_simulations);
    const double part =
        std::min(1.0, static_cast<double>(state_.games) / std::max(run.growth_games, 1));
    const double factor =
        1 + part * (static_cast<double>(run.last_simulations) / actors.simulations - 1);
    const auto grown = [&](int count) {
        return std::max(1, static_cast<int>(std::lround(count * factor)));
    };
    crew_->set_simulations(grown(actors.simulations), grown(actors.fast_simulations));
}

}  // namespace selfplay::training
