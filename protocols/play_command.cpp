// `sanban play`: a game in the terminal; and `sanban` without arguments.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>

#include "engine/base/files.h"
#include "engine/chess/chess.h"
#include "engine/chess/rollouts.h"
#include "engine/go/go.h"
#include "engine/go/rollouts.h"
#include "engine/go/sgf.h"
#include "engine/shogi/rollouts.h"
#include "protocols/board_text.h"
#include "protocols/commands.h"
#include "protocols/flags.h"
#include "protocols/go_judge.h"
#include "protocols/gtp.h"
#include "protocols/terminal.h"
#include "protocols/uci.h"

namespace protocols {

namespace {

struct PlayFlags {
    search::SearchParams params;
    NetworkFlags network;
    TerminalSettings terminal;
    std::string game = "go", colour = "first", rules = "chinese";
    int size = 9;
    double komi = 7.5;
};

// Nothing but a pass once the game is settled.
Ending read_ending(const go::Go& game, GoJudge& judge, search::Searcher<go::Go>& searcher) {
    if (game.consecutive_passes() == 0 && !judge.looks_over(game)) return {};
    const auto reading = judge.read(game);
    const auto end = ending(game, reading, false);
    return bears_out(searcher, game, reading, end) ? end : Ending{};
}

std::string choose_go_move(const go::Go& game, const Ending& end, const search::Analysis& picture) {
    if (end.pass) return "pass";
    const auto wanted = [&](const search::MoveAnalysis& move) {
        if (move.move == go::Go::pass && too_early_to_pass(game)) return false;
        return end.only.empty() ||
               std::find(end.only.begin(), end.only.end(), move.move) != end.only.end();
    };
    const auto best = std::find_if(picture.moves.begin(), picture.moves.end(), wanted);
    return game.move_to_text(best == picture.moves.end() ? go::Go::pass : best->move);
}

void load_network(Session& session, const PlayFlags& flags) {
    if (!flags.network.weights.empty())
        session.load_network(flags.network.weights, flags.network.precision);
}

void save_sgf(const GameSession<go::Go>& session, const std::string& result,
              const std::string& path) {
    std::vector<go::sgf::Turn> turns;
    const auto states = session.states();
    for (std::size_t i = 1; i < states.size(); ++i)
        turns.push_back({states[i - 1].to_play(), *states[i].move_before(0)});
    engine::write_file(path, go::sgf::to_text(go::sgf::tree_of(states.front(), turns, result)));
}

int play_go(const PlayFlags& flags) {
    GameSession<go::Go> session(flags.params);
    session.restart(
        go::Go(flags.size, go::Komi::from_points(flags.komi), go::rules_from_text(flags.rules)));
    load_network(session, flags);
    GoJudge judge(flags.params);
    TerminalView view;
    view.board = [&] { return go::diagram(session.now()); };
    view.result = [&] {
        if (session.now().no_result()) return std::string("no result, by repetition");
        const auto reading = judge.read(session.now());
        auto text = reading.score().text();
        if (!reading.dead().empty())
            text += fmt::format(" ({} dead stones)", reading.dead().size());
        return text;
    };
    view.save = [&](const std::string& path, bool resigned) {
        const bool over = session.now().consecutive_passes() >= 2;
        const bool white_wins = session.to_play() == engine::Player::first;
        save_sgf(session,
                 resigned ? (white_wins ? "W+R" : "B+R")
                 : over   ? judge.read(session.now()).score().text()
                          : "",
                 path);
    };
    view.choose = [&](const search::Analysis& picture) {
        const auto end = read_ending(session.now(), judge, session.searcher());
        return choose_go_move(session.now(), end, picture);
    };
    view.first_name = "Black (X)";
    view.second_name = "White (O)";
    view.move_example = go::vertex({flags.size / 2, flags.size / 2}) + " or pass";
    Terminal(flags.terminal, session, view, std::cin, std::cout).run();
    return 0;
}

std::string saved(std::span<const chess::Chess> states, const std::string&, bool resigned) {
    return to_pgn(states, resigned);
}
std::string saved(std::span<const shogi::Shogi> states, const std::string& path, bool resigned) {
    return to_shogi_record(states, resigned, path.ends_with(".kif"));
}

template <engine::Game G>
int play_board_game(const PlayFlags& flags, TerminalView view) {
    GameSession<G> session(flags.params);
    load_network(session, flags);
    view.board = [&] { return diagram(session.now()); };
    view.result = [&]() -> std::string {
        const auto outcome = session.outcome();
        if (outcome == engine::Outcome::draw) return "a draw";
        return fmt::format(
            "{} wins", outcome == engine::Outcome::first_wins ? view.first_name : view.second_name);
    };
    view.save = [&](const std::string& path, bool resigned) {
        engine::write_file(path, saved(session.states(), path, resigned));
    };
    Terminal(flags.terminal, session, view, std::cin, std::cout).run();
    return 0;
}

TerminalView names(std::string first, std::string second, std::string example) {
    TerminalView view;
    view.first_name = std::move(first);
    view.second_name = std::move(second);
    view.move_example = std::move(example);
    return view;
}

}  // namespace

int run_play(Arguments arguments) {
    CLI::App app("A game on a text board", "sanban play");
    PlayFlags flags;
    flags.params.threads = default_threads();
    add_search_flags(app, flags.params);
    add_network_flags(app, flags.network);
    app.add_option("--game", flags.game, "what to play")
        ->check(CLI::IsMember({"go", "chess", "shogi"}))
        ->capture_default_str();
    app.add_option("--side", flags.colour, "yours: first or second")
        ->check(CLI::IsMember({"first", "second"}))
        ->capture_default_str();
    app.add_option("--time", flags.terminal.seconds, "seconds a move")
        ->check(CLI::Range(0.001, 1e6))
        ->capture_default_str();
    app.add_option("--simulations", flags.terminal.simulations, "a move, instead of a time");
    app.add_option(
        "--save", flags.terminal.record,
        "file that is written after every move (Go: SGF, chess: PGN, shogi: CSA or KIF)");
    app.add_option("--size", flags.size, "of the Go board")
        ->check(CLI::Range(go::min_size, go::max_size))
        ->capture_default_str();
    app.add_option("--komi", flags.komi, "of Go")->capture_default_str();
    app.add_option("--rules", flags.rules, "of Go, by name or as JSON")->capture_default_str();
    if (const auto status = parse_flags(app, arguments)) return *status;
    choose_weights(flags.network, flags.params, flags.game);
    check_method(flags.params, flags.network);
    flags.terminal.human = flags.colour == "first" ? engine::Player::first : engine::Player::second;
    if (flags.game == "go") return play_go(flags);
    if (flags.game == "chess")
        return play_board_game<chess::Chess>(flags, names("White", "Black", "e2e4"));
    return play_board_game<shogi::Shogi>(flags, names("Black (sente)", "White (gote)", "7g7f"));
}

// On a terminal a game of Go; else the protocol that the first line is of.
int run_bare(Arguments arguments) {
    if (::isatty(STDIN_FILENO)) return run_play(arguments);
    Line line;
    do {
        if (!read_line(std::cin, line)) return 0;
    } while (line.text.empty() && !line.too_long);
    const auto first = line.text.substr(0, line.text.find(' '));
    if (first == "uci") return run_uci_from(arguments, line.text);
    if (first == "usi") return run_usi_from(arguments, line.text);
    return run_gtp_from(arguments, line.text);
}

}  // namespace protocols
