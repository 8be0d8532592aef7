// `sanban solve`: how many problems of a file the search, or the mate search, answers as the file
// says.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/base/files.h"
#include "engine/base/text.h"
#include "engine/chess/epd.h"
#include "engine/games.h"
#include "engine/shogi/problem.h"
#include "protocols/commands.h"
#include "protocols/flags.h"
#include "search/load_player.h"
#include "search/mate.h"
#include "search/searcher.h"

namespace protocols {

namespace {

struct SolveFlags {
    search::SearchParams params;
    NetworkFlags network;
    std::string file;
    std::optional<double> seconds;
    std::optional<std::uint64_t> simulations, nodes;
    std::optional<int> mate, no_mate;  // plies

    // Seconds bound what nothing else does.
    std::optional<search::Milliseconds> time(bool otherwise_bounded) const {
        constexpr double usual = 1;
        if (!seconds && otherwise_bounded) return std::nullopt;
        return search::Milliseconds(std::llround(1000 * seconds.value_or(usual)));
    }
};

struct Exercise {
    int number = 0;
    std::string text;
};

struct Verdict {
    bool passed = false;
    std::string found, wanted, id;
    int points = 0, most_points = 0;
};

chess::Problem read_problem(std::type_identity<chess::Chess>, std::string_view line) {
    return chess::problem_from_epd(line);
}
shogi::Problem read_problem(std::type_identity<shogi::Shogi>, std::string_view line) {
    return shogi::problem_from_sfen(line);
}

std::optional<int> plies_of_mate(const chess::Problem& problem) {
    if (!problem.mate_in) return std::nullopt;
    return 2 * *problem.mate_in - 1;
}
std::optional<int> plies_of_mate(const shogi::Problem& problem) { return problem.mate_plies; }

void award_points(const chess::Problem& problem, engine::Move move, Verdict& verdict) {
    for (const auto& [candidate, points] : problem.points) {
        verdict.most_points = std::max(verdict.most_points, points);
        if (candidate == move) verdict.points = points;
    }
}
void award_points(const shogi::Problem&, engine::Move, Verdict&) {}

bool contains(const std::vector<engine::Move>& moves, engine::Move move) {
    return std::find(moves.begin(), moves.end(), move) != moves.end();
}

template <engine::Game G>
std::string text_of(const G& start, const std::vector<engine::Move>& moves, bool in_a_row) {
    std::string text;
    G game = start;
    for (const auto move : moves) {
        text.append(text.empty() ? "" : " ").append(game.move_to_text(move));
        if (in_a_row) game.play(move);
    }
    return text;
}

template <engine::Game G>
class Solver {
   public:
    explicit Solver(const SolveFlags& flags) : flags_(flags) {}

    Verdict solve(std::string_view line) {
        const auto problem = read_problem(std::type_identity<G>(), line);
        auto verdict = answer(problem);
        verdict.id = problem.id;
        return verdict;
    }

   private:
    template <class Problem>
    Verdict answer(const Problem& problem) {
        const auto plies = flags_.mate ? flags_.mate : plies_of_mate(problem);
        if (flags_.no_mate) return refute_mate(problem.game, *flags_.no_mate);
        if (plies) return find_mate(problem.game, *plies);
        if (!problem.best.empty() || !problem.avoid.empty()) return find_move(problem);
        if constexpr (std::is_same_v<G, chess::Chess>)
            engine::fail("neither bm, am nor dm says what is to be found (or give --mate)");
        return find_mate(problem.game, search::MateLimits().plies);
    }

    search::MateResult look_for_mate(const G& game, int plies) const {
        search::MateLimits limits;
        constexpr int most_plies = 255;
        if (plies < 1 || plies > most_plies)
            engine::fail("a mate must be of 1..{} plies, not {}", most_plies, plies);
        limits.plies = plies;
        limits.checks_only = std::is_same_v<G, shogi::Shogi>;
        limits.nodes = flags_.nodes;
        limits.time = flags_.time(flags_.nodes.has_value());
        limits.table_bytes =
            static_cast<std::size_t>(search::mate_mebibytes(flags_.params.memory_mib)) << 20;
        return search::find_mate(game, limits);
    }

    static std::string found(const G& game, const search::MateResult& result) {
        using Answer = search::MateResult::Answer;
        if (result.answer == Answer::mate) return text_of(game, result.line, true);
        return result.answer == Answer::no_mate ? "no mate" : "nothing within the limits";
    }

    Verdict find_mate(const G& game, int plies) const {
        const auto result = look_for_mate(game, plies);
        return {result.answer == search::MateResult::Answer::mate, found(game, result), "a mate",
                ""};
    }

    Verdict refute_mate(const G& game, int plies) const {
        const auto result = look_for_mate(game, plies);
        return {result.answer == search::MateResult::Answer::no_mate, found(game, result),
                "no mate", ""};
    }

    // As front ends do: the network that was named, or the one that this program carries.
    void take_network(const G& game) {
        auto network = flags_.network;
        choose_weights(network, flags_.params, G::name);
        check_method(flags_.params, network);
        if (network.weights.empty()) return;
        searcher_->set_position(game);
        searcher_->set_network(
            search::load_player(network.weights, network.precision, game, flags_.params.method));
        searcher_->warm_up();
    }

    template <class Problem>
    Verdict find_move(const Problem& problem) {
        // Made once it is needed: mates need no tree.
        if (!searcher_) {
            auto params = flags_.params;
            params.memory_mib -= search::mate_mebibytes(params.memory_mib);
            searcher_ = std::make_unique<search::Searcher<G>>(params);
            take_network(problem.game);
        }
        searcher_->set_position(problem.game);
        searcher_->clear();
        search::Limits limits;
        limits.simulations = flags_.simulations;
        limits.time = flags_.time(flags_.simulations.has_value());
        const auto picture = searcher_->think(limits);
        if (!picture.fault.empty()) engine::fail("the search broke off: {}", picture.fault);
        if (picture.moves.empty()) engine::fail("there is no move to find");
        const auto move = picture.moves.front().move;
        Verdict verdict;
        verdict.passed = (problem.best.empty() || contains(problem.best, move)) &&
                         !contains(problem.avoid, move);
        verdict.found = problem.game.move_to_text(move);
        verdict.wanted = problem.best.empty() ? "not " + text_of(problem.game, problem.avoid, false)
                                              : text_of(problem.game, problem.best, false);
        award_points(problem, move, verdict);
        return verdict;
    }

    const SolveFlags& flags_;
    std::unique_ptr<search::Searcher<G>> searcher_;
};

std::vector<Exercise> lines_of(const std::string& path) {
    std::vector<Exercise> lines;
    std::istringstream in(engine::read_file(path));
    int number = 0;
    for (std::string text; std::getline(in, text);) {
        ++number;
        const auto content = engine::trimmed(text);
        if (!content.empty() && content[0] != '#') lines.push_back({number, std::string(content)});
    }
    if (lines.empty()) engine::fail("{}: holds no problem", path);
    return lines;
}

// A shogi board has nine ranks, a chess board eight.
bool is_shogi(std::string_view line) {
    for (auto word = engine::take_word(line); !word.empty(); word = engine::take_word(line))
        if (const auto slashes = std::count(word.begin(), word.end(), '/'); slashes > 0)
            return slashes == 8;
    return false;
}

template <engine::Game G>
int solve_all(const SolveFlags& flags, const std::vector<Exercise>& lines) {
    Solver<G> solver(flags);
    int passed = 0, points = 0, most_points = 0;
    for (const auto& [number, text] : lines) {
        Verdict verdict;
        try {
            verdict = solver.solve(text);
        } catch (const engine::Error& error) {
            engine::fail("{}:{}: {}", flags.file, number, error.what());
        }
        passed += verdict.passed;
        points += verdict.points;
        most_points += verdict.most_points;
        fmt::print("{} {}: {}", verdict.passed ? "passed" : "failed",
                   verdict.id.empty() ? std::to_string(number) : verdict.id, verdict.found);
        fmt::print("{}\n", verdict.passed ? "" : fmt::format(", not {}", verdict.wanted));
        std::fflush(stdout);
    }
    if (most_points > 0) fmt::print("points {} of {}\n", points, most_points);
    fmt::print("{} passed, {} failed\n", passed, static_cast<int>(lines.size()) - passed);
    return 0;
}

}  // namespace

int run_solve(Arguments arguments) {
    CLI::App app(
        "Looks for the answers of problems: chess in EPD (bm, am, dm in moves), shogi in SFEN with "
        "the same operations (dm in plies) or bare, which are mates",
        "sanban solve");
    SolveFlags flags;
    flags.params.threads = default_threads();
    app.add_option("FILE", flags.file, "problems, one a line")->required();
    app.add_option("--time", flags.seconds, "seconds a problem; 1 unless another limit is given")
        ->check(CLI::Range(0.001, 1e6));
    app.add_option("--simulations", flags.simulations, "a problem of best moves");
    app.add_option("--nodes", flags.nodes, "of the mate search, a problem of mate");
    auto* const mate = app.add_option(
        "--mate", flags.mate, "every problem is a mate in at most so many plies of both players");
    app.add_option("--no-mate", flags.no_mate, "no problem has a mate in so many plies")
        ->excludes(mate);
    add_network_flags(app, flags.network);
    add_search_flags(app, flags.params);
    if (const auto status = parse_flags(app, arguments)) return *status;
    const auto lines = lines_of(flags.file);
    return is_shogi(lines.front().text) ? solve_all<shogi::Shogi>(flags, lines)
                                        : solve_all<chess::Chess>(flags, lines);
}

}  // namespace protocols
