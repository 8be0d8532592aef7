#include "protocols/match_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <thread>
#include <vector>

#include "engine/base/error.h"
#include "protocols/commands.h"
#include "protocols/stop_on_signal.h"
#include "selfplay/make_player.h"
#include "selfplay/process.h"
#include "selfplay/time_text.h"

namespace protocols {

namespace {

using selfplay::MatchSettings;
using selfplay::Milliseconds;
using selfplay::Standing;

// What CLI11 fills in, before it is checked and turned into MatchSettings. Lists of engines' own
// values hold one entry for both or one for each.
struct MatchFlags {
    MatchSettings match;
    std::vector<std::string> engines, names, protocols, times;
    std::vector<std::string> init, init_first, init_second;
    std::vector<std::uint64_t> visits;
    std::string dead = "auto", sprt_scale = "logistic", log;
    std::vector<double> sprt;
    std::vector<int> draw, resign;
    int handicap = 0;
    double margin = 0, grace = 5, move_timeout = 300, start_timeout = 120, command_timeout = 30;
    bool same_colours = false;
};

void add_players(CLI::App& app, MatchFlags& input) {
    app.add_option("-e,--engine", input.engines,
                   "command line of an engine, quotes as in a shell; \"internal [name=value]...\" "
                   "is sanban's own search in this process. Twice")
        ->required()
        ->expected(1, 2);
    app.add_option("--name", input.names, "names of the engines")->expected(1, 2);
    app.add_option(
           "--protocol", input.protocols,
           "gtp (Go's default), uci (chess), usi (shogi), xboard (chess), gnushogi: of both "
           "engines, or one for each")
        ->expected(1, 2);
    app.add_option(
           "--visits", input.visits,
           "visits a move instead of time, for both engines or one for each; 0: by the "
           "clock. Sent as kata-set-param maxVisits, lz-setoption Visits, level or go nodes")
        ->expected(1, 2);
    app.add_option("--init", input.init, "line to send to both engines at their start");
    app.add_option("--init1", input.init_first, "line to send to the first engine at its start");
    app.add_option("--init2", input.init_second, "line to send to the second engine at its start");
    app.add_option("--log", input.log, "file to which the engines' stderr is appended");
}

void add_go(CLI::App& app, MatchFlags& input) {
    auto& match = input.match;
    app.add_option("--size", match.go.size, "board size")->capture_default_str();
    app.add_option("--komi", match.go.komi, "komi")->capture_default_str();
    app.add_option("--rules", match.go.rules,
                   "rule set by name or JSON; told to engines that know kata-set-rules")
        ->capture_default_str();
    app.add_option("--handicap", input.handicap, "stones on GTP's fixed points; White begins");
    app.add_option("--dead", input.dead,
                   "agree: stones that both engines call dead come off; stand: the board as it "
                   "stands; auto: agree where the rules ask for it")
        ->check(CLI::IsMember({"auto", "agree", "stand"}))
        ->capture_default_str();
}

void add_game(CLI::App& app, MatchFlags& input) {
    auto& match = input.match;
    app.add_option("--game", match.game, "go, chess or shogi")
        ->check(CLI::IsMember({"go", "chess", "shogi"}))
        ->capture_default_str();
    app.add_option("--entering-king", match.declaration_rule,
                   "shogi: the rule by which a win may be declared, as EnteringKingRule names it; "
                   "who may, has won")
        ->capture_default_str();
    app.add_option("--openings", match.openings.file,
                   "file of games or positions to begin with: SGF; EPD, FEN or PGN; SFEN")
        ->check(CLI::ExistingFile);
    app.add_option("--plies", match.openings.plies, "moves taken from a game of the file")
        ->capture_default_str();
    app.add_option("--random-plies", match.openings.random_plies,
                   "begin with so many random legal moves");
    app.add_option("--seed", match.openings.seed, "of random openings and of the file's order")
        ->capture_default_str();
    app.add_option("--move-limit", match.rules.move_limit,
                   "a draw after so many moves of both; 0: three a point in Go, else none")
        ->capture_default_str();
    app.add_option(
           "--draw", input.draw,
           "call a draw when both engines have told at most SCORE centipawns for MOVES moves "
           "in a row, after move FROM: MOVES SCORE FROM")
        ->expected(3);
    app.add_option(
           "--resign", input.resign,
           "give a game up for an engine that has told -SCORE centipawns or worse for MOVES "
           "moves in a row: MOVES SCORE")
        ->expected(2);
}

void add_schedule(CLI::App& app, MatchFlags& input) {
    auto& match = input.match;
    app.add_option("-n,--games", match.games, "games to play")->capture_default_str();
    app.add_flag("--same-colours", input.same_colours,
                 "the first engine always moves first; else each opening is played with both "
                 "colours");
    app.add_option("-j,--concurrency", match.concurrency,
                   "games at a time, each with its own pair of engines")
        ->capture_default_str();
    app.add_option("-o,--out", match.out,
                   "folder for games.jsonl and games.sgf; an interrupted match goes on from it");
    app.add_option("--sprt", input.sprt, "stop by this test: elo0 elo1 alpha beta")->expected(4);
    app.add_option("--sprt-elo", input.sprt_scale, "scale of elo0 and elo1")
        ->check(CLI::IsMember({"logistic", "normalised"}))
        ->capture_default_str();
}

void add_clock(CLI::App& app, MatchFlags& input) {
    app.add_option("-t,--time", input.times,
                   "for both engines or one for each: \"none\", \"absolute MAIN\", \"byoyomi MAIN "
                   "PERIOD PERIODS\", \"canadian MAIN PERIOD STONES\", \"fischer MAIN INCREMENT\", "
                   "\"session MAIN MOVES [INCREMENT]\", \"move TIME\"; seconds")
        ->expected(1, 2);
    app.add_option("--margin", input.margin, "seconds by which a clock may be overstepped")
        ->capture_default_str();
    app.add_option("--grace", input.grace,
                   "seconds past its clock until a silent engine counts as hung")
        ->capture_default_str();
    app.add_option("--move-timeout", input.move_timeout,
                   "seconds for a move without a clock, then the engine counts as hung")
        ->capture_default_str();
    app.add_option("--start-timeout", input.start_timeout, "seconds until an engine has started")
        ->capture_default_str();
    app.add_option("--command-timeout", input.command_timeout, "seconds for any other answer")
        ->capture_default_str();
}

// The value of engine 0 or 1 from a list of none, one for both, or two.
template <class T>
T value_of(const std::vector<T>& list, std::size_t engine, T otherwise) {
    if (list.empty()) return otherwise;
    return list[std::min(engine, list.size() - 1)];
}

Milliseconds milliseconds(double seconds, const char* what) {
    if (!(seconds >= 0 && seconds <= 1e6))
        engine::fail("--{} must lie in 0..1000000 s, not {}", what, seconds);
    return Milliseconds(std::llround(seconds * 1000));
}

std::string usual_protocol(const std::string& game) {
    return game == "go" ? "gtp" : game == "chess" ? "uci" : "usi";
}

selfplay::PlayerSettings player(const MatchFlags& input, std::size_t engine) {
    selfplay::PlayerSettings player;
    player.command = input.engines[engine];
    const bool internal = selfplay::split_command(player.command)[0] == "internal";
    player.protocol =
        internal ? "internal"
                 : value_of<std::string>(input.protocols, engine, usual_protocol(input.match.game));
    if (input.names.size() > 1 || engine == 0)
        player.name = value_of<std::string>(input.names, engine, "");
    player.init = input.init;
    const auto& own = engine == 0 ? input.init_first : input.init_second;
    player.init.insert(player.init.end(), own.begin(), own.end());
    if (const auto visits = value_of<std::uint64_t>(input.visits, engine, 0))
        player.visits = visits;
    player.log = input.log;
    return player;
}

std::optional<selfplay::Sprt> sprt_of(const MatchFlags& input) {
    if (input.sprt.empty()) return std::nullopt;
    using selfplay::EloScale;
    const auto scale = input.sprt_scale == "logistic" ? EloScale::logistic : EloScale::normalised;
    return selfplay::Sprt{input.sprt[0], input.sprt[1], input.sprt[2], input.sprt[3], scale};
}

selfplay::Adjudication adjudication_of(const MatchFlags& input) {
    selfplay::Adjudication adjudication;
    if (!input.draw.empty()) {
        adjudication.draw_moves = input.draw[0];
        adjudication.draw_score = input.draw[1];
        adjudication.draw_from = input.draw[2];
    }
    if (!input.resign.empty()) {
        adjudication.resign_moves = input.resign[0];
        adjudication.resign_score = input.resign[1];
    }
    return adjudication;
}

void complete_go(const MatchFlags& input, MatchSettings& match) {
    if (match.go.size < go::min_size || match.go.size > go::max_size)
        engine::fail("--size must lie in {}..{}, not {}", go::min_size, go::max_size,
                     match.go.size);
    if (input.handicap != 0)
        for (const auto point : go::fixed_handicap(match.go.size, input.handicap))
            match.go.handicap.push_back(go::vertex(point));
    const auto rules = go::rules_from_text(match.go.rules);
    const bool agreement = rules.friendly_pass || rules.scoring == go::Scoring::territory;
    match.agree_on_dead = input.dead == "agree" || (input.dead == "auto" && agreement);
}

MatchSettings settings_of(const MatchFlags& input) {
    auto match = input.match;
    if (input.engines.size() != 2)
        engine::fail("match needs two engines: give --engine twice, not {} time(s)",
                     input.engines.size());
    for (std::size_t engine = 0; engine < 2; ++engine) {
        match.players[engine] = player(input, engine);
        // A fixed number of visits is not also bound by a clock.
        const auto time = value_of<std::string>(input.times, engine, "none");
        if (!match.players[engine].visits)
            match.rules.time[engine] = selfplay::time_from_text(time);
    }
    match.rules.margin = milliseconds(input.margin, "margin");
    match.rules.grace = milliseconds(input.grace, "grace");
    match.rules.move_timeout = milliseconds(input.move_timeout, "move-timeout");
    match.rules.start_timeout = milliseconds(input.start_timeout, "start-timeout");
    match.rules.command_timeout = milliseconds(input.command_timeout, "command-timeout");
    match.alternate = !input.same_colours;
    match.sprt = sprt_of(input);
    match.rules.adjudication = adjudication_of(input);
    if (match.game == "go") complete_go(input, match);
    return match;
}

std::string_view verdict_text(selfplay::Sprt::Verdict verdict) {
    using Verdict = selfplay::Sprt::Verdict;
    if (verdict == Verdict::accept_elo1) return "elo1";
    return verdict == Verdict::accept_elo0 ? "elo0" : "undecided";
}

struct Elo {
    double low, value, high;
};

Elo elo_of(const selfplay::Tally& tally) {
    const auto interval = selfplay::score_interval(tally);
    return {selfplay::elo_of(interval.low), selfplay::elo_of(tally.score()),
            selfplay::elo_of(interval.high)};
}

int play(const MatchSettings& settings) {
    const StopOnSignal signals;
    selfplay::Match match(settings, [&](int engine, std::stop_token stop) {
        return selfplay::make_player(settings.players[static_cast<std::size_t>(engine)],
                                     settings.game, settings.rules.start_timeout, std::move(stop));
    });
    if (const int played = match.standing().tally.games())
        fmt::print(stderr, "{} games found in {}; going on\n", played, settings.out.string());
    match.run(signals.token(), [](const auto& record, const auto& standing) {
        std::cout << progress_line(record, standing) << std::endl;
    });
    std::cout << summary(match.standing()) << std::flush;
    return 0;
}

}  // namespace

std::string progress_line(const selfplay::GameRecord& record, const Standing& standing) {
    const auto& tally = standing.tally;
    const auto elo = elo_of(tally);
    const int winner = record.winner();
    // What went wrong, where something did: whose fault it was, and how.
    const auto behind = record.by_fault() ? fmt::format(" ({})", record.detail) : record.score;
    auto line =
        fmt::format("game {}/{} {} {}{}{} | {} {} {} | {:.1f} % | Elo {:+.1f} [{:+.1f}, {:+.1f}]",
                    tally.games(), standing.games_wanted,
                    winner < 0 ? "draw" : record.names[static_cast<std::size_t>(winner)],
                    record.reason, record.score.empty() ? "" : " ", behind, tally.wins, tally.draws,
                    tally.losses, 100 * tally.score(), elo.value, elo.low, elo.high);
    if (standing.llr) line += fmt::format(" | LLR {:.2f}", *standing.llr);
    return line;
}

std::string summary(const Standing& standing) {
    const auto& tally = standing.tally;
    const auto elo = elo_of(tally);
    auto text = fmt::format(
        "games {} games\nwins {} games\ndraws {} games\nlosses {} games\nscore {:.1f} %\n"
        "elo {:.1f} Elo\nelo_low {:.1f} Elo\nelo_high {:.1f} Elo\nsuperiority {:.1f} %\n"
        "faults1 {} games\nfaults2 {} games\n",
        tally.games(), tally.wins, tally.draws, tally.losses, 100 * tally.score(), elo.value,
        elo.low, elo.high, 100 * selfplay::likelihood_of_superiority(tally), standing.faults[0],
        standing.faults[1]);
    if (standing.llr)
        text += fmt::format("llr {:.3f} nats\nsprt {} hypothesis\n", *standing.llr,
                            verdict_text(standing.verdict));
    return text;
}

int run_match(Arguments arguments) {
    CLI::App app("Plays two engines against each other; our rules referee every move.",
                 "sanban match");
    MatchFlags input;
    add_players(app, input);
    add_game(app, input);
    add_go(app, input);
    add_schedule(app, input);
    add_clock(app, input);
    std::vector<std::string> words(arguments.begin(), arguments.end());
    std::reverse(words.begin(), words.end());  // CLI11 takes them last first
    try {
        app.parse(std::move(words));
    } catch (const CLI::ParseError& error) {
        return app.exit(error, std::cout, std::cerr) == 0 ? 0 : 2;
    }
    return play(settings_of(input));
}

}  // namespace protocols
