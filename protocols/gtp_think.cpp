// GTP commands that think: moves, analyses, scores.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "protocols/gtp.h"

namespace protocols {

namespace {

using engine::Player;
using search::Analysis;
using search::Milliseconds;

// A reading by rollouts alone, when no search has looked at the position.
constexpr std::uint64_t reading_simulations = 2000;
// A search of so many says enough about the owners of the points.
constexpr std::uint64_t enough_simulations = 200;
constexpr Milliseconds time_to_read{3000};
// Moves in a row below the threshold before the engine resigns, and visits that make one count.
constexpr int hopeless_enough = 3;
constexpr std::uint64_t visits_to_resign = 1000;

bool is_restricted(const search::Limits& limits) {
    return !limits.only.empty() || !limits.avoid.empty();
}

double winrate(float value) { return (value + 1) / 2; }
}  // namespace

search::Limits Gtp::move_limits(Player player) const {
    search::Limits limits;
    if (settings_.simulations > 0) limits.simulations = settings_.simulations;
    const auto& left = clock_.left(player);
    if (!left.control.unlimited)
        limits.clock = left;
    else if (settings_.simulations == 0)
        limits.time = Milliseconds(static_cast<std::int64_t>(settings_.seconds * 1000));
    return limits;
}

// Blocks until the think is over or, as `purpose` allows, cut short by a line of input.
Analysis Gtp::think(const AnalysisRequest& request, Thinking purpose) {
    go::Go game = now();
    game.set_to_play(request.player);
    cut_ = false;
    thinking_ = purpose;
    session_.searcher().set_position(game);
    session_.searcher().start(
        request.limits, [&](const Analysis& picture) { print_analysis(picture, request); }, {});
    if (cut_) session_.interrupt();
    session_.wait();
    thinking_ = Thinking::no;
    auto picture = session_.searcher().analysis();
    if (!picture.fault.empty()) engine::fail("the search broke off: {}", picture.fault);
    remember(picture, request.player, is_restricted(request.limits));
    return picture;
}

void Gtp::remember(const Analysis& picture, Player player, bool restricted) {
    last_picture_ = picture;
    last_player_ = player;
    if (!restricted && !picture.owners.empty() && picture.simulations >= enough_simulations)
        remember_owners(picture, player);
}

// Owners are about the stones: a pass, another mover or other rules leave them true.
void Gtp::remember_owners(const Analysis& picture, Player player) {
    owners_ = picture.owners;
    const auto size = static_cast<std::size_t>(now().size());
    owners_.resize(size * size);
    if (player == Player::second)
        for (float& owner : owners_) owner = -owner;
    read_ = now().board().stones();
}

bool Gtp::knows_owners() const { return !owners_.empty() && read_ == now().board().stones(); }

void Gtp::forget() {
    last_picture_ = {};
    owners_.clear();
}

const Reading& Gtp::reading() {
    if (!knows_owners()) read_by_rollouts();
    return reading_.emplace(now(), owners_);
}

void Gtp::read_by_rollouts() {
    search::Limits limits;
    limits.simulations = reading_simulations;
    // A finished game has nothing to search: read the position before the passes.
    go::Go game(now().size(), now().komi(), now().rules());
    for (int y = 0; y < game.size(); ++y)
        for (int x = 0; x < game.size(); ++x)
            if (const auto stone = now().at({x, y})) game.set_up({x, y}, stone);
    game.set_to_play(now().to_play());
    session_.searcher().set_position(game);
    remember_owners(session_.searcher().think(limits), game.to_play());
}

// A running clock may leave no time for a reading beside the search.
bool Gtp::may_read(Player player) const {
    const auto& left = clock_.left(player);
    return knows_owners() || left.control.unlimited || left.longest_move() > time_to_read;
}

// The liberties of the opponent's dead stones that `player` may play on.
std::vector<go::Move> Gtp::moves_against_dead(Player player) {
    std::vector<go::Move> moves;
    if (!may_read(player)) return moves;
    go::Go game = now();
    game.set_to_play(player);
    for (const auto& point : liberties_of(game, reading().stones(go::Status::dead), ~player))
        if (const auto move = game.move_at(point); game.legal(move)) moves.push_back(move);
    return moves;
}

// The vertex to answer: the search's best move, a pass when nothing is left to gain, or `resign`.
std::string Gtp::choose(const Analysis& picture, Player player, bool clean_up) {
    if (picture.moves.empty()) return "pass";
    go::Go game = now();
    game.set_to_play(player);
    const auto& best = picture.moves.front();
    const bool hopeless = winrate(best.value) < settings_.resign_below &&
                          picture.visits >= visits_to_resign && !clean_up;
    int& hopeless_moves = hopeless_moves_[static_cast<std::size_t>(player)];
    hopeless_moves = hopeless ? hopeless_moves + 1 : 0;
    if (hopeless_moves >= hopeless_enough) return "resign";
    const bool may_pass =
        std::any_of(picture.moves.begin(), picture.moves.end(),
                    [](const search::MoveAnalysis& move) { return move.move == go::Go::pass; });
    if (may_pass && may_read(player) && should_pass(game, reading())) return "pass";
    return game.move_to_text(best.move);
}

std::string Gtp::move_now(Player player, bool play_it, bool clean_up) {
    AnalysisRequest request;
    request.player = player;
    request.limits = move_limits(player);
    if (clean_up) request.limits.only = moves_against_dead(player);
    const auto start = std::chrono::steady_clock::now();
    const auto picture = think(request, Thinking::to_move);
    auto text = choose(picture, player, clean_up);
    if (!play_it) return text;
    clock_.spend(
        player, std::chrono::duration_cast<Milliseconds>(std::chrono::steady_clock::now() - start));
    play_checked(player, text);
    return text;
}

std::string Gtp::genmove(Words& words) { return move_now(words.colour(), true, false); }
std::string Gtp::reg_genmove(Words& words) { return move_now(words.colour(), false, false); }
std::string Gtp::cleanup(Words& words) { return move_now(words.colour(), true, true); }

void Gtp::ponder() {
    if (!result_.empty() || now().consecutive_passes() >= 2) return;
    session_.searcher().set_position(now());
    session_.searcher().start({}, {}, {});
}

std::string Gtp::analyze(Words& words, bool kata, bool floats) {
    const auto request = parse_analysis(words, kata, floats);
    go::Go game = now();
    game.set_to_play(request.player);
    answered_ = true;
    out_.line(fmt::format("={}", id_));
    restricted_ = is_restricted(request.limits);
    thinking_ = Thinking::analysing;
    session_.searcher().set_position(game);
    session_.searcher().start(
        request.limits,
        [this, request](const Analysis& picture) { print_analysis(picture, request); }, {});
    return "";
}

std::string Gtp::lz_analyze(Words& words) { return analyze(words, false, false); }
std::string Gtp::kata_analyze(Words& words) { return analyze(words, true, true); }
std::string Gtp::any_analyze(Words& words) { return analyze(words, false, true); }

// A move's own limits, with the reports and restrictions asked for.
search::Limits Gtp::limits_of(const AnalysisRequest& request) const {
    auto limits = move_limits(request.player);
    limits.report_every = request.limits.report_every;
    limits.only = request.limits.only;
    limits.avoid = request.limits.avoid;
    return limits;
}

std::string Gtp::genmove_analyze(Words& words, bool kata, bool floats) {
    auto request = parse_analysis(words, kata, floats);
    request.limits = limits_of(request);
    answered_ = true;
    out_.line(fmt::format("={}", id_));
    const auto start = std::chrono::steady_clock::now();
    const auto picture = think(request, Thinking::to_move);
    print_analysis(picture, request);
    const auto text = choose(picture, request.player, false);
    clock_.spend(request.player, std::chrono::duration_cast<Milliseconds>(
                                     std::chrono::steady_clock::now() - start));
    play_checked(request.player, text);
    out_.line(fmt::format("play {}\n", text));
    return "";
}

std::string Gtp::lz_genmove_analyze(Words& words) { return genmove_analyze(words, false, false); }
std::string Gtp::kata_genmove_analyze(Words& words) { return genmove_analyze(words, true, true); }
std::string Gtp::any_genmove_analyze(Words& words) { return genmove_analyze(words, false, true); }

std::string Gtp::search_analyze(Words& words, bool cancellable) {
    auto request = parse_analysis(words, true, true);
    request.limits = limits_of(request);
    answered_ = true;
    out_.line(fmt::format("={}", id_));
    const auto picture = think(request, cancellable ? Thinking::cancellable : Thinking::to_move);
    print_analysis(picture, request);
    const bool cancelled = cancellable && cut_;
    out_.line(
        fmt::format("play {}\n", cancelled ? "cancelled" : choose(picture, request.player, false)));
    return "";
}

std::string Gtp::kata_search_analyze(Words& words) { return search_analyze(words, false); }
std::string Gtp::kata_search_cancellable(Words& words) { return search_analyze(words, true); }

std::string Gtp::top_moves(Words&) {
    std::string text;
    for (const auto& move : last_picture_.moves) {
        if (move.visits == 0 || text.size() > 200) break;
        text += fmt::format("{}{} {:.3f}", text.empty() ? "" : " ", now().move_to_text(move.move),
                            winrate(move.value));
    }
    return text;
}

std::string Gtp::final_score(Words&) {
    if (!result_.empty()) return result_;
    if (now().no_result()) return "0";
    return reading().score().text();
}

std::string Gtp::estimate_score(Words&) { return reading().score().text(); }

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
            return "dead";
    }
    return "";
}

}  // namespace protocols
