// A weight file to a network that plays a game: found, read, checked, and run in the precision that
// was asked for, or in the fastest that loses nothing that play would notice. What quantised
// precisions need to know, and our files do not tell, is found out here on games that the network
// plays against itself, and remembered in the user's cache folder.
#pragma once

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "nn/backend.h"
#include "nn/load.h"
#include "search/calibrate.h"
#include "search/fidelity.h"
#include "search/known_networks.h"
#include "search/network_evaluator.h"
#include "search/sample_games.h"

namespace search {

namespace loading {

constexpr bool quantised(nn::Precision precision) { return precision >= nn::Precision::int8; }

template <engine::Encoded G>
struct Samples {
    std::vector<G> seen;   // to calibrate on
    std::vector<G> asked;  // to compare over, from other games
};

// How much computing a calibration may take: `work` floating-point operations for a board size.
struct Budget {
    double work = 0;
    int lines = 8;
    int least_plies = 12, most_plies = 160;
    std::size_t most_positions = 64;  // of a board size, to calibrate on; half of it to compare

    int plies(double flops) const {
        return static_cast<int>(
            std::clamp(work / (flops * lines), double(least_plies), double(most_plies)));
    }
    std::size_t positions(double flops) const {
        return static_cast<std::size_t>(
            std::clamp(work / 4 / flops, 8.0, static_cast<double>(most_positions)));
    }
};

// From games that this network plays, which must have a policy.
template <engine::Encoded G>
Samples<G> sample(const std::shared_ptr<const Network>& network, const G& game) {
    const auto& graph = network->graph();
    const auto& encoding = engine::find_encoding<G>(graph.facts.encoding);
    NetworkEvaluator<G> evaluator(network->in(nn::Precision::bf16));
    engine::Random random(1);
    const auto starts = sample_starts(graph.facts.board, game);
    const Budget budget{1e11 / static_cast<double>(std::max<std::size_t>(starts.size(), 2))};
    Samples<G> samples;
    for (const G& start : starts) {
        const auto flops = static_cast<double>(nn::flop_count(graph, encoding.shape(start).height));
        const auto lines =
            sample_lines(evaluator, start, budget.lines, budget.plies(flops), random);
        const auto each = budget.positions(flops) / (lines.size() / 2);
        for (std::size_t i = 0; i < lines.size(); ++i)
            if (i % 2 == 0)
                pick(lines[i], std::max<std::size_t>(each, 1), samples.seen);
            else
                pick(lines[i], std::max<std::size_t>(each / 2, 1), samples.asked);
    }
    return samples;
}

// The fastest on a board of that side whose answers are close enough to those of fp32.
template <engine::Encoded G>
nn::Precision fastest(const std::shared_ptr<const Network>& reference,
                      const nn::Calibration& calibration, std::span<const G> asked, int board) {
    const auto& encoding = engine::find_encoding<G>(reference->graph().facts.encoding);
    std::vector<G> timed(asked.begin(), asked.end());
    std::erase_if(timed, [&](const G& game) { return encoding.shape(game).height != board; });
    std::vector<nn::Precision> precisions{nn::Precision::fp32};
    std::vector<std::unique_ptr<Evaluator<G>>> evaluators;
    evaluators.push_back(std::make_unique<NetworkEvaluator<G>>(reference));
    const auto expected = answers_to<G>(*evaluators.front(), asked);
    for (const auto precision : {nn::Precision::bf16, nn::Precision::int8, nn::Precision::int16}) {
        if (nn::served_precision(reference->graph(), precision, board) != precision) continue;
        auto evaluator =
            std::make_unique<NetworkEvaluator<G>>(reference->in(precision, calibration));
        if (!tolerable(precision, fidelity_of(expected, answers_to<G>(*evaluator, asked))))
            continue;
        precisions.push_back(precision);
        evaluators.push_back(std::move(evaluator));
    }
    return precisions[fastest_of<G>(evaluators, timed)];
}

// What `choice` comes down to for this game. Adds to what is known whatever it has to find out, on
// games that `player` plays: the network itself, or where it has no policy one that has.
template <engine::Encoded G>
nn::Precision settle(const std::shared_ptr<const Network>& exact,
                     const std::shared_ptr<const Network>& player, PrecisionChoice choice,
                     const G& game, const std::string& key, KnownNetwork& known) {
    const auto& graph = exact->graph();
    const int board = engine::find_encoding<G>(graph.facts.encoding).shape(game).height;
    const auto best = nn::served_precision(graph, nn::Precision::int16, board);
    if (!choice && best == nn::Precision::fp32) return best;
    if (const auto found = known.fastest.find(board); !choice && found != known.fastest.end())
        choice = found->second;
    if (choice && (!quantised(nn::served_precision(graph, *choice, board)) ||
                   !known.calibration.maxima.empty()))
        return *choice;
    const auto samples = sample(player, game);
    if (known.calibration.maxima.empty()) known.calibration = calibrate<G>(graph, samples.seen);
    if (!choice)
        choice = known.fastest[board] = fastest<G>(exact, known.calibration, samples.asked, board);
    remember(key, graph, known);
    return *choice;
}

// Says which precisions that were asked for, or might have been faster, there are not.
inline void tell_lacking(const Network& network, PrecisionChoice choice, int board) {
    std::string lacking;
    for (const auto precision : {nn::Precision::bf16, nn::Precision::int8, nn::Precision::int16}) {
        const auto why = nn::why_not(network.graph(), precision, board);
        if (why.empty() || (choice && precision != *choice)) continue;
        lacking += fmt::format("; no {}: {}", nn::name_of(precision), why);
    }
    if (lacking.empty()) return;
    const auto served = nn::served_precision(network.graph(), network.precision(), board);
    spdlog::warn("{} runs in {}{}", network.graph().facts.name, nn::name_of(served), lacking);
}

// What is in the file, under its own name where the network has none.
inline nn::Contents contents_of(const std::filesystem::path& file) {
    auto contents = nn::load_contents(file);
    if (contents.graph.facts.name.empty()) contents.graph.facts.name = file.filename().string();
    return contents;
}

// A network as its file has it.
struct Exact {
    explicit Exact(nn::Contents contents)
        : network(std::make_shared<const Network>(std::move(contents.graph), nn::Precision::fp32)),
          calibration(std::move(contents.calibration)),
          key(std::move(contents.key)) {}

    std::shared_ptr<const Network> network;  // in fp32
    nn::Calibration calibration;             // may be empty
    std::string key;
};

// The network in the precision that `choice` comes down to; `player` as for settle().
template <engine::Encoded G>
std::shared_ptr<const Network> settled(const Exact& exact,
                                       const std::shared_ptr<const Network>& player,
                                       PrecisionChoice choice, const G& game) {
    const auto& graph = exact.network->graph();
    auto known = recall(exact.key, graph);
    if (!exact.calibration.maxima.empty()) known.calibration = exact.calibration;
    const auto precision = settle(exact.network, player, choice, game, exact.key, known);
    auto network = exact.network->in(precision, known.calibration);
    const auto& encoding = engine::find_encoding<G>(graph.facts.encoding);
    tell_lacking(*network, choice, encoding.shape(game).height);
    return network;
}

}  // namespace loading

// The calibration that a file tells, else one from games of its network with itself; empty for a
// network that answers less than play asks. Fails as load_network.
template <engine::Encoded G>
nn::Calibration calibration_of(const nn::Contents& contents, const G& game = G()) {
    const auto& graph = contents.graph;
    const bool plays = graph.output("policy") && (graph.output("wdl") || graph.output("value"));
    if (!plays || !contents.calibration.maxima.empty()) return contents.calibration;
    const auto exact = std::make_shared<const Network>(graph, nn::Precision::fp32);
    return calibrate<G>(graph, loading::sample(exact, game).seen);
}

// The network of a weight file to play `game` with. Fails with engine::Error, one line, when it
// plays another game or does not serve the board, or when it yields no numbers. Blocks for up to
// some seconds where a calibration is due.
template <engine::Encoded G>
std::shared_ptr<const NetworkSource<G>> source_of(nn::Contents contents, PrecisionChoice choice,
                                                  const G& game) {
    const loading::Exact exact(std::move(contents));
    NetworkSource<G>(exact.network).check(game);
    return std::make_shared<const NetworkSource<G>>(
        loading::settled(exact, exact.network, choice, game), exact.network);
}

// `name`: of a file as find_weights takes it. Fails also when there is no such file, or when it is
// none.
template <engine::Encoded G>
std::shared_ptr<const NetworkSource<G>> load_network(const std::string& name,
                                                     PrecisionChoice choice, const G& game) {
    return source_of(loading::contents_of(find_weights(name)), choice, game);
}

}  // namespace search
