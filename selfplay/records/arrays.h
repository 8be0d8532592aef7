// Self-play games as arrays for other trainers: positions encoded as a network of ours sees them,
// with what there is to learn of each. Blocks until written; from any thread.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "selfplay/records/game.h"

namespace selfplay::records {

struct ArraySettings {
    std::string encoding;  // empty: the one that our own networks are trained with
    int board = 0;         // take the games on this side alone; 0: all, which must then be alike
};

struct ArraySummary {
    std::size_t games = 0, positions = 0, taught = 0;
};

// The arrays, float32, N positions in the order of play, all as the player to move sees them:
//   planes       [N, planes, height, width]
//   globals      [N, numbers]      where the encoding has any
//   policy       [N, moves]        target of the search, summing to 1; zeros where it taught none
//   policy_known [N]               1 where there is a target, else 0
//   value        [N]               how the game ended: 1 won, 0 drawn, -1 lost
//   root_value   [N]               what the search made of the position
//   ownership    [N, height, width]  Go: 1 the mover's at the end, -1 the opponent's, 0 nobody's
//   lead         [N]               Go: final, in points, komi counted
//   score_known  [N]               Go: 1 where the two before are known, 0 where a side resigned
// Fails with engine::Error when there is no position, when games differ in kind or board, on
// illegal moves, and when the file cannot be written.
ArraySummary write_arrays(std::span<const Game> games, const ArraySettings& settings,
                          const std::filesystem::path& path);

}  // namespace selfplay::records
