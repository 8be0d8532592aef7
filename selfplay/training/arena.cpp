#include "selfplay/training/arena.h"

#include <fmt/format.h>

#include "selfplay/make_player.h"

namespace selfplay::training {

namespace {

constexpr int opening_plies = 2;
constexpr int memory_mib = 64;

MatchSettings match_settings(const Settings& settings, const Duel& duel) {
    MatchSettings match;
    match.game = settings.game;
    match.go.size = settings.actors.size;
    match.go.komi = double{settings.actors.komi};
    // As self-play counts: the board as it stands.
    match.go.rules = R"({"ko":"POSITIONAL","friendlyPassOk":false})";
    match.agree_on_dead = false;
    match.players = {duel.first, duel.second};
    match.games = duel.games;
    match.concurrency = duel.concurrency;
    match.openings.random_plies = opening_plies;
    match.openings.seed = duel.seed;
    return match;
}

}  // namespace

PlayerSettings network_player(const std::filesystem::path& weights, int simulations,
                              const Settings& settings) {
    PlayerSettings player;
    player.protocol = "internal";
    player.command =
        fmt::format("internal \"weights={}\" memory={} precision={}", weights.string(), memory_mib,
                    precision_names[static_cast<std::size_t>(settings.run.precision)]);
    player.visits = static_cast<std::uint64_t>(simulations);
    return player;
}

PlayerSettings rollout_player(int simulations) {
    PlayerSettings player;
    player.protocol = "internal";
    player.command = fmt::format("internal search=uct memory={}", memory_mib);
    player.visits = static_cast<std::uint64_t>(simulations);
    return player;
}

Tally play(const Settings& settings, const Duel& duel, const std::stop_token& stop) {
    auto match = match_settings(settings, duel);
    const auto timeout = match.rules.command_timeout;
    Match played(match, [&](int engine, std::stop_token stopped) {
        return make_player(match.players[static_cast<std::size_t>(engine)], match.game, timeout,
                           std::move(stopped));
    });
    played.run(stop, [](const GameRecord&, const Standing&) {});
    return played.standing().tally;
}

Verdict judge(const Settings& settings, const std::filesystem::path& champion,
              const std::filesystem::path& candidate, int threads, const std::stop_token& stop) {
    const int simulations = settings.run.gate_simulations;
    Duel duel;
    duel.first = network_player(candidate, simulations, settings);
    duel.second = network_player(champion, simulations, settings);
    duel.games = settings.run.gate_games;
    duel.concurrency = threads;
    Verdict verdict;
    verdict.tally = play(settings, duel, stop);
    verdict.passed = verdict.tally.games() >= duel.games &&
                     verdict.tally.score() > double{settings.run.gate_score};
    return verdict;
}

}  // namespace selfplay::training
