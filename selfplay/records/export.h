// Self-play games as people read them: in the format that their game's programs exchange, and as a
// list of moves with what the searches said. Functions on values, from any thread.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "selfplay/game_record.h"
#include "selfplay/records/game.h"

namespace selfplay::records {

// Of a file of games, or of all files of a folder, in the order of play. Of a damaged file the
// sound games; what is wrong with it is appended to `damage`, a line each. Fails with engine::Error
// on other files and when there is no game.
std::vector<Game> read_games(const std::filesystem::path& path, std::vector<std::string>& damage);
// Whether `path` is what read_games reads.
bool holds_games(const std::filesystem::path& path);

// As the record of a match that a network played against itself; `index` from 0. Fails with
// engine::Error on illegal moves.
GameRecord match_record(const Game& game, int index);
// SGF, PGN or CSA.
std::string to_text(const Game& game, int index);
// Of such files: "sgf", "pgn", "csa".
std::string_view text_extension(std::string_view game);

// A line for a list: result, length.
std::string summary(const Game& game);
// A line a turn: number, move, value for the mover, simulations, the policy target's best moves.
// Fails with engine::Error on illegal moves.
std::string turns_text(const Game& game);

}  // namespace selfplay::records
