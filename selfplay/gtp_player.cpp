#include "selfplay/gtp_player.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <sstream>
#include <string>

#include "engine/base/error.h"

namespace selfplay {

namespace {

using search::Milliseconds;
using search::TimeControl;

char colour(engine::Player player) { return player == engine::Player::first ? 'b' : 'w'; }

// Whole seconds, as GTP wants them; never more than there are.
long long whole_seconds(Milliseconds time) { return time.count() <= 0 ? 0 : time.count() / 1000; }

// Seconds with their fraction, where an extension takes them.
std::string exact_seconds(Milliseconds time) {
    return fmt::format("{}", static_cast<double>(time.count()) / 1000);
}

// As KataGo's extension writes a time control.
std::string exact_settings(const search::TimeControl& time) {
    const auto main = exact_seconds(time.main), period = exact_seconds(time.period);
    if (time.increment.count() > 0)
        return fmt::format("fischer {} {}", main, exact_seconds(time.increment));
    if (time.periods == 0) return fmt::format("absolute {}", main);
    if (time.period_moves == 1) return fmt::format("byoyomi {} {} {}", main, period, time.periods);
    return fmt::format("canadian {} {} {}", main, period, time.period_moves);
}

std::vector<std::string> words(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> result;
    for (std::string word; in >> word;) result.push_back(word);
    return result;
}

std::string changed_case(std::string text, int (*change)(int)) {
    for (char& c : text) c = static_cast<char>(change(static_cast<unsigned char>(c)));
    return text;
}

}  // namespace

GtpPlayer::GtpPlayer(const PlayerSettings& settings, std::stop_token stop, Deadline deadline)
    : process_(settings.command, {settings.log, std::move(stop)}) {
    for (const auto& command : words(demand("list_commands", deadline))) commands_.insert(command);
    name_ = knows("name") ? ask("name", deadline).text : "";
    for (const auto& line : settings.init) demand(line, deadline);
    if (settings.visits) set_visits(*settings.visits, deadline);
}

GtpPlayer::~GtpPlayer() {
    try {
        process_.write_line("quit", Clock::now());
    } catch (const Fault&) {  // it is gone already, or does not listen: the process gets killed
        return;
    }
}

GtpPlayer::Response GtpPlayer::ask(std::string_view command, Deadline deadline) {
    process_.write_line(command, deadline);
    std::string line = process_.read_line(deadline);
    // Engines greet before the first answer; later on only empty lines may stand between answers.
    while (line.empty() || (!has_answered_ && line[0] != '=' && line[0] != '?'))
        line = process_.read_line(deadline);
    if (line[0] != '=' && line[0] != '?')
        throw Fault(Fault::Kind::protocol, fmt::format("answered {} with: {}", command, line));
    has_answered_ = true;
    Response response{line[0] == '=', line.substr(1)};
    response.text.erase(0, std::min(response.text.find_first_not_of(" \t"), response.text.size()));
    for (line = process_.read_line(deadline); !line.empty(); line = process_.read_line(deadline))
        response.text += '\n' + line;
    return response;
}

std::string GtpPlayer::demand(std::string_view command, Deadline deadline) {
    auto response = ask(command, deadline);
    if (!response.accepted)
        throw Fault(Fault::Kind::protocol, fmt::format("refused {}: {}", command, response.text));
    return std::move(response.text);
}

void GtpPlayer::new_game(const GameSetup& setup, engine::Player, Deadline deadline) {
    if (setup.game != "go") engine::fail("{}: GTP engines play Go only", name_);
    demand(fmt::format("boardsize {}", setup.go.size), deadline);
    demand("clear_board", deadline);
    set_rules(setup.go, deadline);
    demand(fmt::format("komi {}", setup.go.komi), deadline);
    set_time(setup.time, deadline);
    if (!setup.go.handicap.empty()) set_handicap(setup.go, deadline);
}

void GtpPlayer::set_rules(const GoConditions& conditions, Deadline deadline) {
    if (knows("kata-set-rules")) demand("kata-set-rules " + conditions.rules, deadline);
}

void GtpPlayer::set_handicap(const GoConditions& conditions, Deadline deadline) {
    if (knows("set_free_handicap")) {
        std::string command = "set_free_handicap";
        for (const auto& vertex : conditions.handicap) command += ' ' + vertex;
        demand(command, deadline);
        return;
    }
    for (const auto& vertex : conditions.handicap) demand("play b " + vertex, deadline);
}

// The best form of the time control that the engine knows.
std::string GtpPlayer::time_command(const TimeControl& time) const {
    if (knows("kata-time_settings")) return "kata-time_settings " + exact_settings(time);
    if (time.periods > 0 && time.period < std::chrono::seconds(1))
        engine::fail("{}: GTP's own commands tell whole seconds only, not a period of {} s", name_,
                     exact_seconds(time.period));
    if (time.period_moves == 1 && time.periods > 1 && knows("kgs-time_settings"))
        return fmt::format("kgs-time_settings byoyomi {} {} {}", whole_seconds(time.main),
                           whole_seconds(time.period), time.periods);
    const int stones = time.periods > 0 ? time.period_moves : 0;
    return fmt::format("time_settings {} {} {}", whole_seconds(time.main),
                       whole_seconds(time.period), stones);
}

void GtpPlayer::set_time(const TimeControl& time, Deadline deadline) {
    timed_ = !time.unlimited && knows("time_settings");
    if (timed_) demand(time_command(time), deadline);
}

void GtpPlayer::set_visits(std::uint64_t visits, Deadline deadline) {
    if (knows("kata-set-param"))
        demand(fmt::format("kata-set-param maxVisits {}", visits), deadline);
    else if (knows("lz-setoption"))
        demand(fmt::format("lz-setoption name Visits value {}", visits), deadline);
    else if (knows("level"))
        demand(fmt::format("level {}", visits), deadline);
    else
        engine::fail("{}: knows no command that fixes the visits", name_);
}

void GtpPlayer::play(engine::Player mover, std::string_view move, Deadline deadline) {
    demand(fmt::format("play {} {}", colour(mover), move), deadline);
}

void GtpPlayer::tell_time(engine::Player player, const search::TimeLeft& left, Deadline deadline) {
    const bool overtime = left.in_overtime();
    const bool japanese = left.control.period_moves == 1;
    const int stones = !overtime ? 0 : japanese ? left.periods : left.moves;
    const auto seconds = overtime ? left.period : left.main;
    demand(fmt::format("time_left {} {} {}", colour(player),
                       knows("kata-time_settings") ? exact_seconds(seconds)
                                                   : std::to_string(whole_seconds(seconds)),
                       stones),
           deadline);
}

Answer GtpPlayer::think(engine::Player mover, const Clocks& clocks, Deadline deadline) {
    if (timed_ && knows("time_left"))
        for (const auto player : {engine::Player::first, engine::Player::second})
            tell_time(player, clocks[static_cast<std::size_t>(player)], deadline);
    Answer answer;
    answer.move = demand(fmt::format("genmove {}", colour(mover)), deadline);
    if (changed_case(answer.move, std::tolower) == "resign") answer.kind = Answer::Kind::resign;
    return answer;
}

std::optional<std::vector<std::string>> GtpPlayer::dead_stones(Deadline deadline) {
    if (!knows("final_status_list")) return std::nullopt;
    const auto response = ask("final_status_list dead", deadline);
    if (!response.accepted) return std::nullopt;
    return words(changed_case(response.text, std::toupper));
}

}  // namespace selfplay
