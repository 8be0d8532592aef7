// Games by others as records to learn from: PGN, CSA, KIF and SGF become records whose every turn
// teaches the move that was made, and who won. Whoever reads them has checked every move.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "selfplay/records/game.h"

namespace selfplay::records {

struct ImportCounts {
    std::uint64_t kept = 0;
    // Left out: without a result; in Go with handicap, set-up stones or colours out of turn; what
    // cannot be read or played.
    std::uint64_t unfinished = 0, uneven = 0, broken = 0;
};

// The .pgn, .csa, .kif, .ki2, .sgf and .sgfs files, plain or .gz, that `path` is, or that lie
// anywhere below it. Empty where there is none.
std::vector<std::filesystem::path> texts_behind(const std::filesystem::path& path);

// Hands on the games of these files, some at a time and in their order; a game that cannot be read
// is counted, and one that ends its file prematurely the rest of the file with it.
ImportCounts import_games(std::span<const std::filesystem::path> files,
                          const std::function<void(std::span<const Game>)>& take);

}  // namespace selfplay::records
