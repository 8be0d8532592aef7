#include "protocols/uci.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "protocols/uci_stats.h"
#include "protocols/words.h"

namespace protocols {

namespace {

// Between two looks at the search, and between two reports of the same depth.
constexpr search::Milliseconds look_interval{20}, report_interval{500};

// Splits "name X value Y" as setoption sends it; names may hold blanks.
std::pair<std::string, std::string> name_and_value(std::string_view arguments) {
    std::istringstream in{std::string(arguments)};
    std::string name, value;
    std::string* part = nullptr;
    for (std::string word; in >> word;) {
        if (word == "name" && !part) {
            part = &name;
        } else if (word == "value" && part == &name) {
            part = &value;
        } else if (part) {
            part->append(part->empty() ? "" : " ").append(word);
        }
    }
    return {name, value};
}

}  // namespace

int centipawns(float value) {
    constexpr float steepness = 1.5637541897f, scale = 90;
    const float bounded = std::clamp(value, -0.9999f, 0.9999f);
    return static_cast<int>(std::lround(scale * std::tan(steepness * bounded)));
}

Uci::Uci(const Dialect& dialect, std::unique_ptr<Session> session, std::string name, Output& out,
         std::vector<UciOption> extra)
    : dialect_(dialect),
      session_(std::move(session)),
      name_(std::move(name)),
      out_(out),
      options_(common_options()) {
    for (auto& option : extra) options_.push_back(std::move(option));
}

std::vector<Uci::Command> Uci::commands() const {
    return {{dialect_.hello, &Uci::hello},
            {"isready", &Uci::is_ready},
            {"setoption", &Uci::set_option},
            {dialect_.new_game, &Uci::new_game},
            {"position", &Uci::position},
            {"go", &Uci::go},
            {"stop", &Uci::stop},
            {"ponderhit", &Uci::ponder_hit},
            {"gameover", &Uci::game_over},
            {"debug", &Uci::ignore},
            {"register", &Uci::ignore}};
}

void Uci::change(const std::function<void(search::SearchParams&)>& edit) {
    auto params = session_->params();
    edit(params);
    session_->set_params(params);
}

void Uci::serve(std::istream& in) {
    for (Line line; read_line(in, line);) {
        if (line.too_long) {
            out_.line("info string a line longer than a megabyte was ignored");
        } else if (!handle(line.text)) {
            return end_think();
        }
    }
    if (last_go_.infinite || last_go_.ponder) return end_think();
    session_->wait();
    mate_think_.wait();
}

bool Uci::handle(std::string_view line) {
    std::istringstream in{std::string(line)};
    std::string name, arguments;
    if (!(in >> name)) return true;
    if (name == "quit") return false;
    std::getline(in >> std::ws, arguments);
    try {
        for (const auto& command : commands())
            if (command.name == name) return (this->*command.run)(arguments), true;
        out_.line(fmt::format("info string unknown command {}", name.substr(0, 100)));
    } catch (const engine::Error& error) {
        tell(error);
    }
    return true;
}

void Uci::hello(std::string_view) {
    out_.line(fmt::format("id name {}", name_));
    out_.line("id author the sanban authors");
    for (const auto& option : options_)
        out_.line(fmt::format("option name {} {}", option.name, option.declaration));
    out_.line(dialect_.hello_done);
}

void Uci::is_ready(std::string_view) {
    load_network();
    out_.line("readyok");
}

void Uci::set_network(const std::string& file, search::PrecisionChoice precision) {
    weights_ = file;
    precision_ = precision;
    network_due_ = true;
}

// The GUI waits for its answer whatever happens.
void Uci::load_network() {
    if (!std::exchange(network_due_, false)) return;
    end_think();
    try {
        session_->load_network(weights_, precision_);
    } catch (const engine::Error& error) {
        tell(error);
    }
}

void Uci::tell(const engine::Error& error) {
    out_.line(fmt::format("info string error: {}", error.what()));
}

void Uci::set_option(std::string_view arguments) {
    const auto [name, value] = name_and_value(arguments);
    for (const auto& option : options_) {
        if (lower(option.name) != lower(name)) continue;
        // The GUI still waits for a move: a think with an end gives it now, another one goes on.
        const auto under_way = last_go_;
        const bool goes_on = session_->thinking() && (under_way.infinite || under_way.ponder);
        if (goes_on)
            end_think();
        else
            stop({});
        try {
            option.set(value);
        } catch (const engine::Error& error) {
            tell(error);
        }
        if (goes_on) begin(under_way);
        return;
    }
    engine::fail("there is no option '{}'", name);
}

void Uci::new_game(std::string_view) {
    end_think();
    lag_.forget_game();
    session_->new_game();
}

void Uci::position(std::string_view arguments) {
    end_think();
    std::istringstream in{std::string(arguments)};
    std::string word, start;
    std::vector<std::string> moves;
    in >> word;
    if (word == dialect_.position) {
        while (in >> word && word != "moves") start.append(start.empty() ? "" : " ").append(word);
        if (start.empty()) engine::fail("position {}: the position is missing", dialect_.position);
    } else if (word == "startpos") {
        in >> word;
    } else {
        engine::fail("position must go on with startpos or {}, not '{}'", dialect_.position, word);
    }
    while (in >> word) moves.push_back(word);
    session_->set_position(start, moves);
}

void Uci::go(std::string_view arguments) {
    end_think();
    begin(parse_go(arguments, dialect_.white_first));
}

void Uci::begin(const GoCommand& go) {
    load_network();
    think(go);
}

void Uci::think(const GoCommand& go) {
    last_go_ = go;
    begun_ = std::chrono::steady_clock::now();
    silenced_ = false;
    mate_.reset();
    mate_known_ = false;
    allowed_.clear();
    if (go.mate && dialect_.asks_for_checkmate) return solve(go);
    const bool answers = !go.infinite && !go.ponder;
    if (answers && session_->can_declare_win()) return out_.line("bestmove win");
    if (answers && session_->legal_moves().empty())
        return out_.line(fmt::format("bestmove {}", dialect_.no_move));
    search(go);
}

search::Limits Uci::search_limits(const GoCommand& go) {
    auto limits = limits_of(go, session_->to_play());
    if (most_simulations_ > 0 && !go.infinite)
        limits.simulations =
            std::min(limits.simulations.value_or(most_simulations_), most_simulations_);
    for (const auto& text : go.search_moves) {
        if (const auto move = session_->move_from_text(text))
            allowed_.push_back(*move);
        else
            out_.line(fmt::format("info string searchmoves: {} is not legal here", text));
    }
    limits.only = allowed_;
    if (limits.clock) {
        lag_.shown(*limits.clock);
        limits.clock = lag_.without_lag(*limits.clock);
    }
    if (limits.time) {
        const search::Milliseconds overhead(session_->params().lag_ms);
        limits.time = search::move_within(*limits.time, overhead);
    }
    limits.report_every = look_interval;
    return limits;
}

void Uci::search(const GoCommand& go) {
    const auto limits = search_limits(go);
    reported_depth_ = 0;
    reported_at_ = search::Milliseconds(0);
    if (go.mate) start_mate_think(go);
    session_->start(
        limits, [this](const auto& picture) { progress(picture); },
        [this](const auto& picture) { finish(picture); });
    // It may have been known before there was a search to interrupt.
    if (mate_known_) session_->interrupt();
}

search::MateLimits Uci::mate_limits(const GoCommand& go) {
    search::MateLimits limits;
    limits.nodes = go.nodes;
    return limits;
}

// Beside the search, which it ends by a mate, or by there being none when nothing else would.
void Uci::start_mate_think(const GoCommand& go) {
    auto limits = mate_limits(go);
    const auto moves = static_cast<std::uint64_t>(limits.plies + 1) / 2;
    if (*go.mate > 0 && *go.mate < moves) limits.plies = static_cast<int>(2 * *go.mate - 1);
    const bool waits = go.infinite || go.ponder;
    const bool bounded = go.nodes || go.move_time || go.depth || go.has_clock();
    mate_think_.start(*session_, limits, [this, waits, bounded](const search::MateResult& result) {
        using Answer = search::MateResult::Answer;
        mate_ = result;
        // A mate by a move that is not asked for is none.
        if (result.answer == Answer::mate && !allowed_.empty() &&
            std::find(allowed_.begin(), allowed_.end(), result.line[0]) == allowed_.end())
            mate_->answer = Answer::no_mate;
        if (waits || mate_->answer == Answer::unknown) return;
        if (mate_->answer == Answer::no_mate && bounded) return;
        mate_known_ = true;
        session_->interrupt();
    });
}

void Uci::solve(const GoCommand& go) {
    auto limits = mate_limits(go);
    limits.checks_only = true;
    limits.time = search::Milliseconds(std::min(*go.mate, most_milliseconds));
    mate_think_.start(*session_, limits,
                      [this](const search::MateResult& result) { tell_solution(result); });
}

void Uci::tell_solution(const search::MateResult& result) {
    using Answer = search::MateResult::Answer;
    if (silenced_) return;
    const auto* const otherwise = result.answer == Answer::no_mate ? "nomate" : "timeout";
    out_.line(fmt::format("checkmate {}", result.answer == Answer::mate
                                              ? session_->line_to_text(result.line)
                                              : otherwise));
}

void Uci::stop(std::string_view) {
    session_->stop();
    mate_think_.stop();
}

void Uci::ponder_hit(std::string_view arguments) {
    if (!session_->thinking()) return;
    if (arguments.empty()) {
        last_go_.ponder = false;
        begun_ = std::chrono::steady_clock::now();
        return session_->ponder_hit();
    }
    // The times come only now (ShogiHome's early ponder): think on, in the same tree, under them.
    end_think();
    think(parse_go(arguments, dialect_.white_first));
}

void Uci::game_over(std::string_view) { end_think(); }

// Ends a think whose bestmove nobody waits for any more.
void Uci::end_think() {
    silenced_ = true;
    session_->stop();
    mate_think_.stop();
}

// At each look: a line when the depth has grown, or after some time.
void Uci::progress(const search::Analysis& picture) {
    const bool deeper = picture.depth > reported_depth_;
    if (deeper || picture.elapsed >= reported_at_ + report_interval) report(picture);
    if (last_go_.depth && picture.depth >= *last_go_.depth) session_->interrupt();
}

void Uci::report(const search::Analysis& picture) {
    if (silenced_) return;
    reported_depth_ = picture.depth;
    reported_at_ = picture.elapsed;
    const auto lines =
        std::min<std::size_t>(static_cast<std::size_t>(multi_pv_), picture.moves.size());
    for (std::size_t rank = 0; rank < lines; ++rank) out_.line(info(picture, rank));
}

void Uci::finish(const search::Analysis& picture) {
    mate_think_.stop();
    if (silenced_) return;
    if (!picture.fault.empty())
        out_.line(fmt::format("info string the search broke off: {}", picture.fault));
    if (!tell_mate(picture)) {
        report(picture);
        if (verbose_)
            for (const auto& line : verbose_stats(*session_, picture)) out_.line(line);
        out_.line(best_move(picture));
    }
    if (!last_go_.ponder)
        lag_.answered(std::chrono::duration_cast<search::Milliseconds>(
            std::chrono::steady_clock::now() - begun_));
}

// Whether the mate search has the answer.
bool Uci::tell_mate(const search::Analysis& picture) {
    if (!mate_) return false;
    if (mate_->answer != search::MateResult::Answer::mate) {
        out_.line("info string found no such mate");
        return false;
    }
    const auto plies = mate_->line.size();
    const auto line = session_->line_to_text(mate_->line);
    out_.line(fmt::format("info depth {} seldepth {} time {} nodes {} score mate {} pv {}", plies,
                          plies, std::max<std::int64_t>(picture.elapsed.count(), 0), mate_->nodes,
                          (plies + 1) / 2, line));
    std::istringstream words(line);
    std::string best, answer;
    words >> best >> answer;
    const bool ponder = offers_ponder_ && !answer.empty();
    out_.line(fmt::format("bestmove {}{}", best, ponder ? " ponder " + answer : ""));
    return true;
}

std::string Uci::info(const search::Analysis& picture, std::size_t rank) const {
    auto move = picture.moves[rank];
    // Nothing else is known of a move that the search has not tried, as after a single visit.
    if (move.visits == 0 && !move.sure) move.value = picture.value, move.draws = picture.draws;
    const auto time = std::max<std::int64_t>(picture.elapsed.count(), 0);
    const auto rate =
        picture.simulations * 1000 / static_cast<std::uint64_t>(std::max<std::int64_t>(time, 1));
    return fmt::format(
        "info depth {} seldepth {} time {} nodes {} score {}{}{} hashfull {} nps {} multipv {} "
        "pv {}",
        std::max(picture.depth, 1), std::max(picture.deepest, 1), time, picture.simulations,
        score(move), wdl(picture, move), moves_left(picture),
        static_cast<int>(1000 * picture.memory_used), rate, rank + 1,
        session_->line_to_text(move.variation));
}

// Mates in moves over UCI, in plies over USI; negative where the mover is mated.
std::string Uci::score(const search::MoveAnalysis& move) const {
    if (!move.sure || *move.sure == 0) return fmt::format("cp {}", centipawns(move.value));
    const int plies = *move.sure;
    if (dialect_.asks_for_checkmate) return fmt::format("mate {}", plies);
    return fmt::format("mate {}", plies > 0 ? (plies + 1) / 2 : plies / 2);
}

// In per mille, and in all 1000: draws as often as expected, the rest by the value without them.
std::string Uci::wdl(const search::Analysis& picture, const search::MoveAnalysis& move) const {
    if (!shows_wdl_) return {};
    const auto whole = [](float share) { return static_cast<int>(std::lround(1000 * share)); };
    const float value = move.value - move.draws * picture.draw_score;
    const int draws = whole(std::clamp(move.draws, 0.0f, 1 - std::min(std::abs(value), 1.0f)));
    const int decided = 1000 - draws;
    const int wins = std::clamp((decided + whole(value)) / 2, 0, decided);
    return fmt::format(" wdl {} {} {}", wins, draws, decided - wins);
}

std::string Uci::moves_left(const search::Analysis& picture) const {
    if (!shows_moves_left_ || picture.plies_left <= 0) return {};
    return fmt::format(" movesleft {}", std::lround((picture.plies_left + 1) / 2));
}

std::string Uci::best_move(const search::Analysis& picture) const {
    const auto legal = session_->legal_moves();
    if (session_->can_declare_win()) return "bestmove win";
    if (legal.empty()) return fmt::format("bestmove {}", dialect_.no_move);
    if (picture.moves.empty()) return fmt::format("bestmove {}", session_->move_to_text(legal[0]));
    const auto& best = picture.moves[0];
    if (resign_per_mille_ > 0 && 500 * (best.value + 1) < static_cast<float>(resign_per_mille_))
        return "bestmove resign";
    auto text = fmt::format("bestmove {}", session_->move_to_text(best.move));
    if (offers_ponder_ && best.variation.size() > 1) {
        const auto line = session_->line_to_text(std::span(best.variation).first(2));
        text += fmt::format(" ponder {}", line.substr(line.find(' ') + 1));
    }
    return text;
}

}  // namespace protocols
