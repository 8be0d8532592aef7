// GTP commands that think: moves and scores.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>

#include "protocols/gtp.h"

namespace protocols {

namespace {

using engine::Player;
using search::Analysis;
using search::Milliseconds;
using Clock = std::chrono::steady_clock;

// Moves in a row below the threshold before the engine resigns, and visits that make one count.
constexpr int hopeless_enough = 3;
constexpr std::uint64_t visits_to_resign = 100;

Milliseconds since(Clock::time_point start) {
    return std::chrono::duration_cast<Milliseconds>(Clock::now() - start);
}

// What is left after `used` of the move's own time.
search::TimeLeft reduced(search::TimeLeft left, Milliseconds used) {
    auto& running = left.in_overtime() ? left.period : left.main;
    running = std::max(running - used, Milliseconds(1));
    return left;
}

// Where the move is known, only what is there to be shown of it is searched.
void shorten(search::Limits& limits) {
    limits.simulations = std::min<std::uint64_t>(limits.simulations.value_or(500), 500);
    limits.time = Milliseconds(100);
    limits.clock.reset();
}

bool is_suicide(const go::Go& game, go::Move move) {
    const auto point = game.point_of(move);
    if (!point) return false;
    go::Go after = game;
    after.play(move);
    return !after.at(*point);
}

// Where a pass is always better, or nearly: and for suicide, where the rules allow it, opponents
// and referees that know no such rules would make the game a lost one.
void avoid_useless(const go::Go& game, std::vector<go::Move>& avoid) {
    for (const go::Move move : game.legal_moves())
        if (game.fills_own_eye(move) || (game.rules().suicide && is_suicide(game, move)))
            avoid.push_back(move);
}

// Where the search broke off before it knew any.
std::string any_move(const go::Go& game) {
    for (const auto move : game.legal_moves())
        if (move != go::Go::pass && !game.fills_own_eye(move)) return game.move_to_text(move);
    return "pass";
}

// With so few moves played a game is not given up, however it stands; a handicap makes White
// look lost for longer.
bool too_early_to_resign(const go::Go& game) {
    return game.move_count() < game.size() * game.size() / (game.handicap() > 1 ? 3 : 8);
}

}  // namespace

// The position to search: as it is, or without what ended the game in it.
go::Go Gtp::root_for(Player player) const {
    auto root = now().outcome() == engine::Outcome::ongoing ? now() : without_history(now());
    root.set_to_play(player);
    return root;
}

search::Limits Gtp::move_limits(Player player) {
    search::Limits limits;
    limits.ply = now().move_count();
    if (settings_.simulations > 0) limits.simulations = settings_.simulations;
    if (settings_.visits > 0) {
        session_.searcher().set_position(root_for(player));
        const auto kept = session_.searcher().analysis(0).visits;
        const auto missing = settings_.visits > kept ? settings_.visits - kept : 1;
        limits.simulations = std::min(limits.simulations.value_or(missing), missing);
    }
    const auto left = clock_.for_a_move(player);
    if (!left.control.unlimited)
        limits.clock = left;
    else if (!limits.simulations)
        limits.time = Milliseconds(static_cast<std::int64_t>(settings_.seconds * 1000));
    return limits;
}

// From here to the end of the next think.
void Gtp::allow_cut(Cut cut) {
    const std::lock_guard lock(cut_mutex_);
    cut_ = cut;
    was_cut_ = false;
}

// Blocks until the think is over or, as allow_cut() said, a line of input cuts it short.
Analysis Gtp::think(const go::Go& root, const search::Limits& limits,
                    const AnalysisRequest* reports) {
    auto& searcher = session_.searcher();
    searcher.set_position(root);
    searcher.start(limits, reports ? printer(*reports) : Session::Report(), {});
    {
        const std::lock_guard lock(cut_mutex_);
        if (was_cut_) session_.interrupt();  // while the end of the game was read
    }
    if (input_) input_->waiting([this](std::string_view line) { return arrived(line), false; });
    session_.wait();
    {
        const std::lock_guard lock(cut_mutex_);
        cut_ = Cut::by_none;
    }
    remember(root);
    if (!last_picture_.fault.empty())
        spdlog::error("the search broke off: {}", last_picture_.fault);
    return last_picture_;
}

void Gtp::remember(const go::Go& root) {
    last_picture_ = session_.searcher().analysis();
    last_root_ = root;
}

// How long the end of the game may be read before a move; without a clock as long as it takes.
std::optional<Milliseconds> Gtp::reading_time(Player player) const {
    const auto& left = clock_.left(player);
    if (left.control.unlimited) return std::nullopt;
    return std::min(left.longest_move() / 32, Milliseconds(1000));
}

// The opponent went on after a pass of ours: perhaps the board counts as it stands, whatever the
// rules say. Where captures cost nothing they then come before the next pass.
bool Gtp::disputed(Player player) const {
    if (now().rules().scoring != go::Scoring::area) return false;
    const auto goes_on = [&](const go::sgf::Turn& one, const go::sgf::Turn& next) {
        return one.player == player && one.move == go::Go::pass && next.player != player &&
               next.move != go::Go::pass;
    };
    return std::adjacent_find(turns_.begin(), turns_.end(), goes_on) != turns_.end();
}

Ending Gtp::read_ending(const go::Go& game, bool clean_up) {
    constexpr Milliseconds too_short{20};
    const auto time = reading_time(game.to_play());
    if (time && *time < too_short) return {};
    const bool last_word = game.consecutive_passes() > 0 || clean_up;
    if (!last_word && !judge_.looks_over(game, time)) return {};
    const auto reading = judge_.read(game, time);
    if (judge_.hasty()) return {};
    auto end = ending(game, reading, clean_up);
    if (clean_up || bears_out(session_.searcher(), root_for(game.to_play()), reading, end, time))
        return end;
    return {};
}

// The vertex to answer: a pass when nothing is left to gain, else the search's best move, or
// `resign`.
std::string Gtp::choose(const Errand& errand) {
    const auto start = Clock::now();
    allow_cut(errand.cut);
    go::Go game = now();
    game.set_to_play(errand.player);
    auto limits = move_limits(errand.player);
    if (errand.reports) {
        limits.report_every = errand.reports->every;
        limits.only = errand.reports->only;
        limits.avoid = errand.reports->avoid;
    }
    const bool restricted = !limits.only.empty() || !limits.avoid.empty();
    const bool cleans_up = errand.cleans_up || disputed(errand.player);
    const auto end = restricted ? Ending{} : read_ending(game, cleans_up);
    if (limits.only.empty()) avoid_useless(game, limits.avoid);
    if (end.pass)
        shorten(limits);
    else if (!restricted && too_early_to_pass(game))
        limits.avoid.push_back(go::Go::pass);
    limits.only.insert(limits.only.end(), end.only.begin(), end.only.end());
    if (limits.clock) limits.clock = reduced(*limits.clock, since(start));
    const auto picture = think(root_for(errand.player), limits, errand.reports);
    if (errand.reports) printer (*errand.reports)(picture);
    return end.pass ? "pass" : best_move(picture, errand);
}

std::string Gtp::best_move(const Analysis& picture, const Errand& errand) {
    go::Go game = now();
    game.set_to_play(errand.player);
    // The search may have looked at a board without history: superko is asked for here.
    const auto best =
        std::find_if(picture.moves.begin(), picture.moves.end(),
                     [&](const search::MoveAnalysis& move) { return game.legal(move.move); });
    if (best == picture.moves.end()) return picture.fault.empty() ? "pass" : any_move(game);
    const bool hopeless = winrate(best->value) < settings_.resign_below &&
                          picture.visits >= visits_to_resign && !errand.cleans_up &&
                          !too_early_to_resign(game);
    int& hopeless_moves = hopeless_moves_[static_cast<std::size_t>(errand.player)];
    if (errand.plays) hopeless_moves = hopeless ? hopeless_moves + 1 : 0;
    if (hopeless && hopeless_moves >= hopeless_enough) return "resign";
    return game.move_to_text(best->move);
}

std::string Gtp::genmove(const Errand& errand) {
    if (!result_.empty() && errand.plays) engine::fail("the game is over: {}", result_);
    const auto start = Clock::now();
    auto text = choose(errand);
    if (!errand.plays) return text;
    clock_.spend(errand.player, since(start));
    play_checked(errand.player, text);
    if (result_.empty()) ponder_on_ = now();
    return text;
}

std::string Gtp::genmove_command(Words& words) { return genmove({words.colour()}); }
std::string Gtp::reg_genmove(Words& words) { return genmove({words.colour(), false}); }
std::string Gtp::cleanup(Words& words) { return genmove({words.colour(), true, true}); }

std::string Gtp::benchmark(Words& words) {
    search::Limits limits;
    limits.simulations = static_cast<std::uint64_t>(words.whole("the visits", 1, 1'000'000'000));
    session_.new_game();
    allow_cut(Cut::by_interrupt);
    const auto picture = think(root_for(now().to_play()), limits, nullptr);
    const auto time = std::max<double>(static_cast<double>(picture.elapsed.count()), 1);
    return fmt::format(
        "{} simulations in {:.3f} s, {:.0f} a second, {} threads", picture.simulations, time / 1000,
        1000 * static_cast<double>(picture.simulations) / time, session_.params().threads);
}

std::string Gtp::final_score(Words&) {
    if (!result_.empty()) return result_;
    if (now().no_result()) return "0";
    return reading().score().text();
}

std::string Gtp::estimate_score(Words&) { return reading().played_out().text(); }

std::string Gtp::final_status_list(Words& words) {
    const auto wanted = words.take("the status");
    if (wanted == "alive") return points_text(reading().stones(go::Status::alive));
    if (wanted == "seki") return points_text(reading().stones(go::Status::seki));
    if (wanted == "dead") return points_text(reading().stones(go::Status::dead));
    engine::fail("the status is alive, seki or dead, not {}", wanted);
}

std::string Gtp::final_status(Words& words) {
    const auto point = vertex_of(words.take("the vertex"));
    if (!now().at(point)) engine::fail("there is no stone at {}", go::vertex(point));
    switch (reading().status(point)) {
        case go::Status::alive:
            return "alive";
        case go::Status::seki:
            return "seki";
        case go::Status::dead:
            break;
    }
    return "dead";
}

}  // namespace protocols
