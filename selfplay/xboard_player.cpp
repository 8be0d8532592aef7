#include "selfplay/xboard_player.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <sstream>
#include <utility>
#include <vector>

#include "engine/base/error.h"

namespace selfplay {

namespace {

using namespace std::chrono_literals;
using search::TimeLeft;

bool begins(std::string_view line, std::string_view with) {
    return line.substr(0, with.size()) == with;
}

long long centiseconds(const TimeLeft& left) { return left.longest_move().count() / 10; }

// Engines without promotion letters in lower case, or with '=', mean the same move.
std::string plain_move(std::string text) {
    text.erase(std::remove(text.begin(), text.end(), '='), text.end());
    const bool coordinates = text.size() == 5 &&
                             std::isdigit(static_cast<unsigned char>(text[1])) != 0 &&
                             std::isdigit(static_cast<unsigned char>(text[3])) != 0;
    if (coordinates) text[4] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[4])));
    return text;
}

// The move in "move e2e4", "My move is : e2e4" or "1. ... e2e4"; empty when the line holds none.
std::string xboard_move(const std::string& line) {
    std::istringstream words(line);
    std::vector<std::string> list;
    for (std::string word; words >> word;) list.push_back(word);
    if (list.size() == 2 && list[0] == "move") return plain_move(list[1]);
    if (begins(line, "My move is") && list.size() >= 4) return plain_move(list.back());
    if (list.size() == 3 && list[1] == "...") return plain_move(list[2]);
    return {};
}

// "1-0 {…}" as the outcome it claims.
std::optional<engine::Outcome> claim_in(const std::string& line) {
    if (begins(line, "1-0")) return engine::Outcome::first_wins;
    if (begins(line, "0-1")) return engine::Outcome::second_wins;
    if (begins(line, "1/2-1/2")) return engine::Outcome::draw;
    return std::nullopt;
}

// Score in a line of thinking: "ply score time nodes variation".
std::optional<int> thinking_score(const std::string& line) {
    std::istringstream numbers(line);
    int ply = 0, score = 0;
    long long time = 0, nodes = 0;
    if (numbers >> ply >> score >> time >> nodes) return score;
    return std::nullopt;
}

}  // namespace

XboardPlayer::XboardPlayer(const PlayerSettings& settings, std::stop_token stop, Deadline deadline)
    : process_(settings.command, {settings.log, std::move(stop)}) {
    if (settings.visits)
        engine::fail("{}: xboard engines count no visits (send \"sd N\" by --init instead)",
                     settings.command);
    process_.write_line("xboard", deadline);
    process_.write_line("protover 2", deadline);
    hear_features(deadline);
    for (const auto& line : settings.init) process_.write_line(line, deadline);
}

XboardPlayer::~XboardPlayer() {
    try {
        process_.write_line("quit", Clock::now());
    } catch (const Fault&) {  // it is gone already, or does not listen: the process gets killed
        return;
    }
}

std::string XboardPlayer::feature(const std::string& name, const std::string& otherwise) const {
    const auto found = features_.find(name);
    return found == features_.end() ? otherwise : found->second;
}

// Until done=1; without any features for 2 s, the engine speaks version 1. done=0 asks for more
// time.
void XboardPlayer::hear_features(Deadline deadline) {
    auto patience = std::min(deadline, Clock::now() + 2s);
    for (;;) {
        const auto line = process_.try_read_line(patience);
        if (!line) return;
        if (!begins(*line, "feature ")) continue;
        if (note_features(std::string_view(*line).substr(8))) return;
        if (feature("done") == "0") patience = deadline;
    }
}

// name=value pairs, values quoted or not. Whether "done=1" was among them.
bool XboardPlayer::note_features(std::string_view text) {
    while (!text.empty()) {
        text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
        const auto equals = text.find('=');
        if (equals == text.npos) break;
        const std::string name(text.substr(0, equals));
        text.remove_prefix(equals + 1);
        const bool quoted = !text.empty() && text[0] == '"';
        if (quoted) text.remove_prefix(1);
        const auto end = std::min(text.find(quoted ? '"' : ' '), text.size());
        features_[name] = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return feature("done") == "1";
}

void XboardPlayer::new_game(const GameSetup& setup, engine::Player, Deadline deadline) {
    for (const auto* command : {"new", "force", "easy", "post"})
        process_.write_line(command, deadline);
    set_level(setup.time, deadline);
    if (!setup.start.empty()) {
        if (feature("setboard") != "1")
            throw Fault(Fault::Kind::protocol, "cannot be given a position (no setboard)");
        process_.write_line("setboard " + setup.start, deadline);
    }
    synchronise(deadline);
}

// "level" counts main time in minutes and seconds; overtime is only known as a fixed time a move.
void XboardPlayer::set_level(const search::TimeControl& time, Deadline deadline) {
    if (time.unlimited) return;
    const auto seconds = [](search::Milliseconds t) {
        return std::max<long long>(t.count() / 1000, 1);
    };
    if (time.main.count() == 0) {
        process_.write_line(fmt::format("st {}", seconds(time.period)), deadline);
        return;
    }
    const auto main = seconds(time.main);
    process_.write_line(fmt::format("level {} {}:{:02} {}", time.moves_per_session, main / 60,
                                    main % 60, time.increment.count() / 1000),
                        deadline);
}

// Waits until the engine has worked off what it was sent, where it knows "ping".
void XboardPlayer::synchronise(Deadline deadline) {
    if (feature("ping") != "1") return;
    process_.write_line(fmt::format("ping {}", ++pings_), deadline);
    const auto wanted = fmt::format("pong {}", pings_);
    for (auto line = process_.read_line(deadline); line != wanted;
         line = process_.read_line(deadline))
        if (begins(line, "Illegal move"))
            throw Fault(Fault::Kind::protocol, "refused a legal move: " + line);
}

void XboardPlayer::play(engine::Player, std::string_view move, Deadline deadline) {
    const auto* prefix = feature("usermove") == "1" ? "usermove " : "";
    process_.write_line(fmt::format("{}{}", prefix, move), deadline);
    synchronise(deadline);
}

Answer XboardPlayer::think(engine::Player mover, const Clocks& clocks, Deadline deadline) {
    const auto& own = clocks[static_cast<std::size_t>(mover)];
    const auto& other = clocks[static_cast<std::size_t>(~mover)];
    if (!own.control.unlimited && feature("time", "1") == "1") {
        process_.write_line(fmt::format("time {}", centiseconds(own)), deadline);
        const auto& shown = other.control.unlimited ? own : other;
        process_.write_line(fmt::format("otim {}", centiseconds(shown)), deadline);
    }
    process_.write_line("go", deadline);
    auto answer = read_answer(mover, deadline);
    process_.write_line("force", deadline);
    return answer;
}

Answer XboardPlayer::read_answer(engine::Player mover, Deadline deadline) {
    Answer answer;
    for (;;) {
        const auto line = process_.read_line(deadline);
        if (auto move = xboard_move(line); !move.empty()) {
            answer.move = std::move(move);
            return answer;
        }
        if (const auto score = thinking_score(line)) answer.centipawns = score;
        const auto claim = claim_in(line);
        if (line == "resign" || begins(line, "tellics resign") ||
            claim == engine::win_for(~mover)) {
            answer.kind = Answer::Kind::resign;
            return answer;
        }
        if (claim) throw Fault(Fault::Kind::protocol, "claimed a result that is none: " + line);
        if (begins(line, "Illegal move"))
            throw Fault(Fault::Kind::protocol, "refused a legal move: " + line);
    }
}

}  // namespace selfplay
