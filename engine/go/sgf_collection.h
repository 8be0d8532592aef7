// How much of a collection of Go records our rules agree with: every main line replays or is
// refused for a reason. For tools that show a file, and tests.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

namespace go::sgf {

struct Refusal {
    std::int64_t game = 0, line = 0;  // from 1; the line on which the game begins
    std::string message;              // "FILE, game 3 (line 3): move 57: W[cd] is illegal: ko"
};

struct CollectionReport {
    std::int64_t games = 0, replayed = 0, moves = 0;
    std::int64_t noted = 0;                       // replayed with notes (sgf::Record)
    std::map<std::string, std::int64_t> reasons;  // of the refused: "ko", "occupied" …

    std::int64_t refused() const { return games - replayed; }
};

// Replays at most `most_games` games of the file (plain or .gz), telling `on_refusal` of each that
// is refused. Fails naming the file when it cannot be read or holds no game.
CollectionReport check_collection(const std::filesystem::path& path,
                                  const std::function<void(const Refusal&)>& on_refusal = {},
                                  std::int64_t most_games = INT64_MAX);

}  // namespace go::sgf
