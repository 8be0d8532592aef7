// The folder a match is written to: games.jsonl, whose first line says which match it is and every
// other one game, and games.sgf (or the like), made from it. A line that was cut by a crash is
// dropped on resuming.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "selfplay/game_record.h"
#include "selfplay/rulebook.h"

namespace selfplay {

class MatchFiles {
   public:
    // An empty folder name writes nothing. `identity` is one line of JSON. Fails with
    // engine::Error when the folder holds a match of another identity, saying where they differ.
    MatchFiles(std::filesystem::path folder, const std::string& identity, const Rulebook& rulebook);

    // The games found on opening.
    const std::vector<GameRecord>& resumed() const { return resumed_; }
    void add(const GameRecord& record);

   private:
    std::filesystem::path lines_path() const { return folder_ / "games.jsonl"; }
    std::filesystem::path games_path() const;
    void resume(const std::string& identity);
    void rewrite(const std::string& identity) const;

    std::filesystem::path folder_;
    const Rulebook& rulebook_;
    std::vector<GameRecord> resumed_;
};

}  // namespace selfplay
