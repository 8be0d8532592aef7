#include "selfplay/line_openings.h"

#include <sstream>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/files.h"

namespace selfplay {

std::optional<Opening> playable(Opening opening, int plies, const MakeReferee& referee) try {
    const auto most = static_cast<std::size_t>(plies);
    if (opening.moves.size() > most) opening.moves.resize(most);
    const auto game = referee(opening.start);
    for (auto& move : opening.moves) {
        auto played = game->play(move);
        if (!played.objection.empty()) return std::nullopt;
        move = std::move(played.move);
    }
    if (game->verdict().outcome != engine::Outcome::ongoing) return std::nullopt;
    return opening;
} catch (const engine::Error&) {
    return std::nullopt;
}

std::vector<Opening> openings_of_lines(const std::filesystem::path& path, int plies,
                                       const ReadLine& read, const MakeReferee& referee) {
    std::istringstream lines(engine::read_file(path));
    std::vector<Opening> openings;
    for (std::string line; std::getline(lines, line);) {
        if (!line.empty() && line.back() == '\r') line.pop_back();
        auto opening = read(line);
        if (!opening) continue;
        if (auto checked = playable(std::move(*opening), plies, referee))
            openings.push_back(std::move(*checked));
    }
    if (openings.empty()) engine::fail("{}: holds no position to begin with", path.string());
    return openings;
}

std::optional<Opening> opening_of_position(std::string_view line) {
    std::istringstream words{std::string(line)};
    Opening opening;
    bool in_moves = false;
    for (std::string word; words >> word;) {
        if (word == "moves")
            in_moves = true;
        else if (in_moves)
            opening.moves.push_back(word);
        else if (word != "position" && word != "startpos" && word != "sfen" && word != "fen")
            opening.start += (opening.start.empty() ? "" : " ") + word;
    }
    if (opening.start.empty() && line.find("startpos") == line.npos) return std::nullopt;
    return opening;
}

}  // namespace selfplay
