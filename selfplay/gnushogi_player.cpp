#include "selfplay/gnushogi_player.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "engine/base/error.h"

namespace selfplay {

namespace {

// The move in "12. ... 3a3b 299590"; empty when the line is another, such as the echo of a move
// that was put in ("12. 7g7f 299700").
std::string gnushogi_move(const std::string& line) {
    std::istringstream words(line);
    std::string number, dots, move;
    if (words >> number >> dots >> move && dots == "...") return move;
    return {};
}

}  // namespace

GnushogiPlayer::GnushogiPlayer(const PlayerSettings& settings, std::stop_token stop,
                               Deadline deadline)
    : process_(settings.command, {settings.log, std::move(stop)}) {
    if (settings.visits)
        engine::fail("{}: gnushogi counts no visits (send \"depth N\" by --init instead)",
                     settings.command);
    name_ = process_.read_line(deadline);  // "GNU Shogi 1.4.2"
    for (const auto& line : settings.init) process_.write_line(line, deadline);
}

GnushogiPlayer::~GnushogiPlayer() {
    try {
        process_.write_line("quit", Clock::now());
    } catch (const Fault&) {  // it is gone already, or does not listen: the process gets killed
        return;
    }
}

void GnushogiPlayer::new_game(const GameSetup& setup, engine::Player, Deadline deadline) {
    if (!setup.start.empty()) throw Fault(Fault::Kind::protocol, "cannot be given a position");
    for (const auto* command : {"new", "force"}) process_.write_line(command, deadline);
    if (setup.time.unlimited) return;
    // Moves and minutes; the clock is set again before each move.
    process_.write_line("level 40 5", deadline);
}

void GnushogiPlayer::play(engine::Player, std::string_view move, Deadline deadline) {
    process_.write_line(move, deadline);
}

Answer GnushogiPlayer::think(engine::Player mover, const Clocks& clocks, Deadline deadline) {
    const auto& own = clocks[static_cast<std::size_t>(mover)];
    if (!own.control.unlimited) {
        // Until "go" the side to move counts as the opponent, so that its clock is the other's.
        constexpr int moves_to_come = 40;
        const bool overtime = own.in_overtime();
        const auto time = overtime ? own.period : own.longest_move();
        // It takes up to twice the share of one move.
        const int moves = overtime ? 2 * std::max(own.moves, 1) : moves_to_come;
        process_.write_line(fmt::format("otime {} {}", time.count() / 10, moves), deadline);
    }
    process_.write_line("go", deadline);
    Answer answer;
    while (answer.move.empty()) {
        const auto line = process_.read_line(deadline);
        answer.move = gnushogi_move(line);
        if (answer.move.empty() && line.find("Resigns") != line.npos) {
            answer.kind = Answer::Kind::resign;
            return answer;
        }
        if (line.find("Illegal move") != line.npos)
            throw Fault(Fault::Kind::protocol, "refused a legal move: " + line);
    }
    process_.write_line("force", deadline);
    return answer;
}

}  // namespace selfplay
