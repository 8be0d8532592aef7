// Openings from files that hold one position a line.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "selfplay/game_record.h"
#include "selfplay/referee.h"

namespace selfplay {

// What one line of the file says, if it says anything.
using ReadLine = std::function<std::optional<Opening>(std::string_view line)>;
using MakeReferee = std::function<std::unique_ptr<Referee>(const std::string& start)>;

// The openings that can be played from: legal, and not over. Their moves are cut after `plies` and
// rewritten as the game writes them. Fails with engine::Error when the file holds none.
std::vector<Opening> openings_of_lines(const std::filesystem::path& path, int plies,
                                       const ReadLine& read, const MakeReferee& referee);

// "startpos moves …" or "[sfen|fen] POSITION [moves …]", with or without "position" before it.
std::optional<Opening> opening_of_position(std::string_view line);

// As openings_of_lines does with each; empty when it cannot be played from.
std::optional<Opening> playable(Opening opening, int plies, const MakeReferee& referee);

}  // namespace selfplay
