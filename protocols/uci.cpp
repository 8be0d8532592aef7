#include "protocols/uci.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace protocols {

namespace {

constexpr search::Milliseconds report_interval{500};

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
    return result;
}

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

template <class T>
T number_within(std::string_view name, std::string_view text, T least, T most) {
    const T value = engine::parse_number<T>(text);
    if (value < least || value > most)
        engine::fail("{} must lie in {}..{}, not {}", name, least, most, text);
    return value;
}

bool yes_or_no(std::string_view name, std::string_view text) {
    if (text != "true" && text != "false")
        engine::fail("{} must be true or false, not {}", name, text);
    return text == "true";
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

std::vector<UciOption> Uci::common_options() {
    const auto number = [this](std::string name, std::string_view row) {
        const auto rows = engine::option_rows(session_->params());
        const auto found =
            std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return r.name == row; });
        return UciOption{std::move(name),
                         fmt::format("type spin default {} min {} max {}", found->value,
                                     found->least, found->most),
                         [this, row](std::string_view text) {
                             change([&](auto& params) { engine::set_option(params, row, text); });
                         }};
    };
    std::vector<UciOption> options{
        number("Threads", "threads"), number(std::string(dialect_.hash_option), "memory"),
        number(dialect_.knows_resignation ? "NetworkDelay" : "Move Overhead", "lag"),
        number("Seed", "seed")};
    options.push_back(
        {"MultiPV", "type spin default 1 min 1 max 256",
         [this](std::string_view text) { multi_pv_ = number_within("MultiPV", text, 1, 256); }});
    options.push_back({std::string(dialect_.ponder_option), "type check default true",
                       [this](std::string_view text) {
                           offers_ponder_ = yes_or_no(dialect_.ponder_option, text);
                       }});
    options.push_back({dialect_.knows_resignation ? "ClearHash" : "Clear Hash", "type button",
                       [this](std::string_view) { session_->new_game(); }});
    if (dialect_.knows_resignation)
        options.push_back({"ResignThreshold", "type spin default 0 min 0 max 1000",
                           [this](std::string_view text) {
                               resign_per_mille_ = number_within("ResignThreshold", text, 0, 1000);
                           }});
    else
        options.push_back(
            {"UCI_AnalyseMode", "type check default false", [this](std::string_view text) {
                 const bool analyse = yes_or_no("UCI_AnalyseMode", text);
                 change([&](auto& params) { params.early_end = !analyse; });
             }});
    return options;
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
    if (session_->thinking() && (last_go_.infinite || last_go_.ponder)) return end_think();
    session_->wait();
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
        out_.line(fmt::format("info string error: {}", error.what()));
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

void Uci::is_ready(std::string_view) { out_.line("readyok"); }

void Uci::set_option(std::string_view arguments) {
    const auto [name, value] = name_and_value(arguments);
    for (const auto& option : options_) {
        if (lower(option.name) != lower(name)) continue;
        end_think();
        return option.set(value);
    }
    engine::fail("there is no option '{}'", name);
}

void Uci::new_game(std::string_view) {
    end_think();
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
    think(parse_go(arguments, dialect_.white_first));
}

void Uci::think(const GoCommand& go) {
    last_go_ = go;
    const auto legal = session_->legal_moves();
    if (!go.infinite && !go.ponder && session_->can_declare_win()) return out_.line("bestmove win");
    if (!go.infinite && !go.ponder && legal.empty())
        return out_.line(fmt::format("bestmove {}", dialect_.no_move));
    auto limits = limits_of(go, session_->to_play());
    for (const auto& text : go.search_moves) {
        if (const auto move = session_->move_from_text(text))
            limits.only.push_back(*move);
        else
            out_.line(fmt::format("info string searchmoves: {} is not legal here", text));
    }
    limits.report_every = report_interval;
    depth_limit_ = go.depth;
    silenced_ = false;
    session_->start(
        limits, [this](const auto& picture) { report(picture); },
        [this](const auto& picture) { finish(picture); });
}

void Uci::stop(std::string_view) { session_->stop(); }

void Uci::ponder_hit(std::string_view arguments) {
    if (!session_->thinking()) return;
    if (arguments.empty()) {
        last_go_.ponder = false;
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
}

void Uci::report(const search::Analysis& picture) {
    if (silenced_) return;
    const auto lines =
        std::min<std::size_t>(static_cast<std::size_t>(multi_pv_), picture.moves.size());
    for (std::size_t rank = 0; rank < lines; ++rank) out_.line(info(picture, rank));
    if (depth_limit_ && picture.depth >= *depth_limit_) session_->interrupt();
}

void Uci::finish(const search::Analysis& picture) {
    if (silenced_) return;
    if (!picture.fault.empty())
        out_.line(fmt::format("info string the search broke off: {}", picture.fault));
    report(picture);
    out_.line(best_move(picture));
}

std::string Uci::info(const search::Analysis& picture, std::size_t rank) const {
    const auto& move = picture.moves[rank];
    const auto time = std::max<std::int64_t>(picture.elapsed.count(), 0);
    const auto rate =
        picture.simulations * 1000 / static_cast<std::uint64_t>(std::max<std::int64_t>(time, 1));
    return fmt::format(
        "info depth {} seldepth {} time {} nodes {} score cp {} hashfull {} nps {} multipv {} pv "
        "{}",
        std::max(picture.depth, 1), std::max(picture.deepest, 1), time, picture.simulations,
        centipawns(move.value), static_cast<int>(1000 * picture.memory_used), rate, rank + 1,
        session_->line_to_text(move.variation));
}

std::string Uci::best_move(const search::Analysis& picture) const {
    const auto legal = session_->legal_moves();
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
