// GTP commands that think: moves, analysis, scores.
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
// Moves in a row below the threshold before the engine resigns, and visits that make one count.
constexpr int hopeless_enough = 3;
constexpr std::uint64_t visits_to_resign = 1000;

double winrate(float value) { return (value + 1) / 2; }
int per_ten_thousand(float value) { return static_cast<int>(std::lround(10000 * winrate(value))); }

std::string variation_text(const go::Go& game, const std::vector<go::Move>& moves) {
    std::string text;
    for (const auto move : moves) text.append(text.empty() ? "" : " ") += game.move_to_text(move);
    return text;
}

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
    remember(picture);
    return picture;
}

void Gtp::remember(const Analysis& picture) {
    last_picture_ = picture;
    if (picture.owners.empty() || picture.simulations < reading_simulations / 2) return;
    // The position searched may be the present one with the other side to move; the stones, which
    // a reading is about, are the same.
    reading_.emplace(now(), black_owners(picture));
    read_ = now();
}

std::vector<float> Gtp::black_owners(const Analysis& picture) const {
    auto owners = picture.owners;
    if (session_.searcher().position().to_play() == Player::second)
        for (float& owner : owners) owner = -owner;
    return owners;
}

const Reading& Gtp::reading() {
    if (read_ && reading_ && *read_ == now()) return *reading_;
    search::Limits limits;
    limits.simulations = reading_simulations;
    // A finished game has nothing to search: read the position before the passes.
    go::Go game(now().size(), now().komi(), now().rules());
    for (int y = 0; y < game.size(); ++y)
        for (int x = 0; x < game.size(); ++x)
            if (const auto stone = now().at({x, y})) game.set_up({x, y}, stone);
    game.set_to_play(now().to_play());
    session_.searcher().set_position(game);
    const auto picture = session_.searcher().think(limits);
    reading_.emplace(now(),
                     picture.owners.empty()
                         ? std::vector<float>(static_cast<std::size_t>(now().size() * now().size()))
                         : black_owners(picture));
    read_ = now();
    return *reading_;
}

// The vertex to answer: the search's best move, a pass when nothing is left to gain, or `resign`.
std::string Gtp::choose(const Analysis& picture, Player player, bool clean_up) {
    if (picture.moves.empty()) return "pass";
    go::Go game = now();
    game.set_to_play(player);
    const auto& best = picture.moves.front();
    const bool hopeless = winrate(best.value) < settings_.resign_below &&
                          picture.visits >= visits_to_resign && !clean_up;
    hopeless_moves_ = hopeless ? hopeless_moves_ + 1 : 0;
    if (hopeless_moves_ >= hopeless_enough) return "resign";
    const Reading& read = reading();
    const bool dead_left = !read.stones(go::Status::dead).empty();
    if (should_pass(game, read) && !(clean_up && dead_left)) return "pass";
    return game.move_to_text(best.move);
}

std::string Gtp::move_now(Player player, bool play_it, bool clean_up) {
    AnalysisRequest request;
    request.player = player;
    request.limits = move_limits(player);
    const auto start = std::chrono::steady_clock::now();
    const auto picture = think(request, Thinking::to_move);
    const auto text = choose(picture, player, clean_up);
    clock_.spend(
        player, std::chrono::duration_cast<Milliseconds>(std::chrono::steady_clock::now() - start));
    if (play_it) play_checked(player, text);
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

// The grammar of lz-analyze and kata-analyze: [COLOUR] [CENTISECONDS] {KEY VALUE}.
Gtp::AnalysisRequest Gtp::parse_analysis(Words& words, bool kata, bool floats) const {
    AnalysisRequest request;
    request.kata = kata;
    request.floats = floats;
    request.player = now().to_play();
    request.limits.report_every = Milliseconds(1000);
    const auto interval = [&] {
        const double centiseconds = words.number("the interval", 0, 1e7);
        request.limits.report_every =
            Milliseconds(std::max<std::int64_t>(std::llround(10 * centiseconds), 10));
    };
    const auto is_colour = [&] {
        const char c = static_cast<char>(words.peek()[0] | 32);
        const auto size = words.peek().size();
        return (c == 'b' || c == 'w') && (size == 1 || size == 5);
    };
    if (!words.empty() && is_colour()) request.player = words.colour();
    if (!words.empty() && words.peek().find_first_not_of("0123456789.") == std::string::npos)
        interval();
    while (!words.empty()) {
        const std::string key(words.take("the key"));
        if (key == "interval") {
            interval();
        } else if (key == "minmoves") {
            request.least_moves = words.whole("minmoves", 0, 1000);
        } else if (key == "maxmoves") {
            request.most_moves = words.whole("maxmoves", 1, 1000);
        } else if (key == "avoid" || key == "allow") {
            parse_restriction(words, key == "allow", request);
        } else {
            const bool yes = words.take("true or false") == "true";
            if (key == "rootInfo") request.root_info = yes;
            if (key == "ownership") request.ownership = yes;
            if (key == "pvVisits") request.visits_of_variation = yes;
        }
    }
    return request;
}

// avoid COLOUR V,V,... DEPTH: a ban on the first move of the side to move; deeper plies are free.
void Gtp::parse_restriction(Words& words, bool allow, AnalysisRequest& request) const {
    const auto player = words.colour();
    const std::string list(words.take("the vertices"));
    words.whole("the depth", 1, 1000);
    if (player != request.player) return;
    go::Go game = now();
    game.set_to_play(player);
    std::size_t start = 0;
    while (start <= list.size()) {
        const auto end = std::min(list.find(',', start), list.size());
        const auto text = list.substr(start, end - start);
        const auto move = game.move_from_text(text);
        if (!move && text != "pass") vertex_of(text);
        if (move) (allow ? request.limits.only : request.limits.avoid).push_back(*move);
        start = end + 1;
    }
}

void Gtp::print_analysis(const Analysis& picture, const AnalysisRequest& request) {
    if (picture.moves.empty()) return;
    std::string line;
    int order = 0;
    for (const auto& move : picture.moves) {
        if (order >= request.most_moves) break;
        if (move.visits == 0 && order >= std::max(request.least_moves, 1)) break;
        line += fmt::format("{}info move {} visits {} ", line.empty() ? "" : " ",
                            now().move_to_text(move.move), move.visits);
        if (request.floats)
            line += fmt::format("winrate {:.6f} prior {:.6f} lcb {:.6f}", winrate(move.value),
                                move.prior, winrate(move.lcb));
        else
            line += fmt::format("winrate {} prior {} lcb {}", per_ten_thousand(move.value),
                                std::lround(10000 * move.prior), per_ten_thousand(move.lcb));
        if (request.kata)
            line += fmt::format(" utility {:.6f} utilityLcb {:.6f}", move.value, move.lcb);
        line += fmt::format(" order {}", order++);
        if (request.visits_of_variation) {
            line += " pvVisits";
            for (const auto visits : move.variation_visits) line += fmt::format(" {}", visits);
        }
        line += fmt::format(" pv {}", variation_text(now(), move.variation));
    }
    if (request.root_info)
        line += fmt::format(" rootInfo visits {} utility {:.6f} winrate {:.6f} scoreLead {:.3f}",
                            picture.visits, picture.value, winrate(picture.value), picture.lead);
    if (request.ownership && !picture.owners.empty()) {
        line += " ownership";
        const auto size = static_cast<std::size_t>(now().size());
        for (std::size_t y = size; y-- > 0;)
            for (std::size_t x = 0; x < size; ++x)
                line += fmt::format(" {:.3f}", picture.owners[y * size + x]);
    }
    out_.line(line);
}

std::string Gtp::analyze(Words& words, bool kata, bool floats) {
    const auto request = parse_analysis(words, kata, floats);
    go::Go game = now();
    game.set_to_play(request.player);
    answered_ = true;
    out_.line(fmt::format("={}", id_));
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

std::string Gtp::genmove_analyze(Words& words, bool kata, bool floats) {
    auto request = parse_analysis(words, kata, floats);
    const auto report_every = request.limits.report_every;
    const auto only = request.limits.only, avoid = request.limits.avoid;
    request.limits = move_limits(request.player);
    request.limits.report_every = report_every;
    request.limits.only = only;
    request.limits.avoid = avoid;
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
    const auto report_every = request.limits.report_every;
    request.limits = move_limits(request.player);
    request.limits.report_every = report_every;
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
