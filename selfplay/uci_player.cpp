#include "selfplay/uci_player.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <utility>

#include "engine/base/error.h"

namespace selfplay {

namespace {

using search::Milliseconds;
using search::TimeLeft;

constexpr UciDialect uci{"uci", "uciok", "ucinewgame", "fen", "w", "b", false, false};
constexpr UciDialect usi{"usi", "usiok", "usinewgame", "sfen", "b", "w", true, true};

// What may be thought in all before time runs out, for protocols that know of no overtime.
Milliseconds main_of(const TimeLeft& left, bool byoyomi) {
    return byoyomi ? std::max(left.main, Milliseconds(0)) : left.longest_move();
}

// The judgement in an "info" line, if it holds one: mates count as more than any position.
std::optional<int> info_score(const std::string& line) {
    constexpr int mate = 100000;
    std::istringstream words(line);
    std::string word, kind, value;
    while (words >> word)
        if (word == "score" && words >> kind >> value) break;
    if (value.empty() || (kind != "cp" && kind != "mate")) return std::nullopt;
    if (kind == "mate") return value[0] == '-' ? -mate : mate;
    std::istringstream number(value);
    int centipawns = 0;
    if (number >> centipawns) return centipawns;
    return std::nullopt;
}

}  // namespace

const UciDialect& uci_dialect() { return uci; }
const UciDialect& usi_dialect() { return usi; }

UciPlayer::UciPlayer(const PlayerSettings& settings, const UciDialect& dialect,
                     std::stop_token stop, Deadline deadline)
    : dialect_(dialect),
      process_(settings.command, {settings.log, std::move(stop)}),
      nodes_(settings.visits) {
    process_.write_line(dialect_.greeting, deadline);
    for (std::string line; line != dialect_.greeted; line = process_.read_line(deadline))
        note_greeting(line);
    for (const auto& line : settings.init) process_.write_line(line, deadline);
    process_.write_line("isready", deadline);
    await("readyok", deadline);
}

UciPlayer::~UciPlayer() {
    try {
        process_.write_line("quit", Clock::now());
    } catch (const Fault&) {  // it is gone already, or does not listen: the process gets killed
        return;
    }
}

void UciPlayer::note_greeting(std::string_view line) {
    constexpr std::string_view id = "id name ";
    if (line.substr(0, id.size()) == id) name_ = line.substr(id.size());
    if (line.find("option name UCI_Chess960 ") == 0) knows_chess960_ = true;
}

void UciPlayer::await(std::string_view word, Deadline deadline) {
    while (process_.read_line(deadline) != word) continue;
}

void UciPlayer::new_game(const GameSetup& setup, engine::Player side, Deadline deadline) {
    side_ = side;
    position_ = setup.start.empty() ? "position startpos"
                                    : fmt::format("position {} {}", dialect_.position, setup.start);
    any_moves_ = false;
    if (knows_chess960_)
        process_.write_line(fmt::format("setoption name UCI_Chess960 value {}", setup.chess960),
                            deadline);
    // USI has the new game after readyok, UCI before it.
    if (!dialect_.tells_result) process_.write_line(dialect_.new_game, deadline);
    process_.write_line("isready", deadline);
    await("readyok", deadline);
    if (dialect_.tells_result) process_.write_line(dialect_.new_game, deadline);
}

void UciPlayer::play(engine::Player, std::string_view move, Deadline) {
    position_ += std::exchange(any_moves_, true) ? " " : " moves ";
    position_ += move;
}

std::string UciPlayer::go_command(engine::Player mover, const Clocks& clocks) const {
    const auto& own = clocks[static_cast<std::size_t>(mover)];
    if (nodes_) return fmt::format("go nodes {}", *nodes_);
    if (own.control.unlimited) engine::fail("{}: needs a time control or a number of nodes", name_);
    const auto& control = own.control;
    const bool fixed = control.main.count() == 0 && control.periods == 1 &&
                       control.period_moves == 1 && control.increment.count() == 0;
    if (fixed && !dialect_.byoyomi) return fmt::format("go movetime {}", control.period.count());
    return "go " + clock_words(mover, clocks);
}

std::string UciPlayer::clock_words(engine::Player mover, const Clocks& clocks) const {
    const auto& own = clocks[static_cast<std::size_t>(mover)];
    // An opponent without a clock is shown with the mover's own.
    const auto shown = [&](std::size_t side) -> const TimeLeft& {
        return clocks[side].control.unlimited ? own : clocks[side];
    };
    const auto& first = shown(0);
    const auto& second = shown(1);
    auto words =
        fmt::format("{}time {} {}time {}", dialect_.first, main_of(first, dialect_.byoyomi).count(),
                    dialect_.second, main_of(second, dialect_.byoyomi).count());
    if (own.control.increment.count() > 0)
        words += fmt::format(" {}inc {} {}inc {}", dialect_.first, first.control.increment.count(),
                             dialect_.second, second.control.increment.count());
    else if (dialect_.byoyomi)
        words += fmt::format(" byoyomi {}", own.control.periods > 0 ? own.period.count() : 0);
    if (own.control.moves_per_session > 0) words += fmt::format(" movestogo {}", own.moves);
    return words;
}

Answer UciPlayer::think(engine::Player mover, const Clocks& clocks, Deadline deadline) {
    const auto go = go_command(mover, clocks);
    process_.write_line(position_, deadline);
    process_.write_line(go, deadline);
    auto answer = read_answer(deadline);
    if (answer.kind == Answer::Kind::move) play(mover, answer.move, deadline);
    return answer;
}

Answer UciPlayer::read_answer(Deadline deadline) {
    Answer answer;
    for (;;) {
        const auto line = process_.read_line(deadline);
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "info") {
            if (const auto score = info_score(line)) answer.centipawns = score;
        } else if (word == "bestmove") {
            words >> answer.move;
            if (answer.move == "resign") answer.kind = Answer::Kind::resign;
            if (answer.move == "win") answer.kind = Answer::Kind::claim_win;
            return answer;
        }
    }
}

void UciPlayer::game_over(engine::Outcome outcome, Deadline deadline) {
    if (!dialect_.tells_result) return;
    const float value = engine::value_for(side_, outcome);
    const auto* word = value > 0 ? "win" : value < 0 ? "lose" : "draw";
    process_.write_line(fmt::format("gameover {}", word), deadline);
}

}  // namespace selfplay
