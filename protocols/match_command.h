// `sanban match`: engines against each other, from the command line.
#pragma once

#include <array>
#include <string>

#include "selfplay/match.h"

namespace protocols {

// One line on the game just finished and on the match so far, without line end:
// "game 3/40 sanban score W+3.5 | 2 0 1 | 66.7 % | Elo +120.4 [-210.0, +inf]".
std::string progress_line(const selfplay::GameRecord& record, const selfplay::Standing& standing);
// The final figures, one a line: "name value unit".
std::string summary(const selfplay::Standing& standing);

}  // namespace protocols
