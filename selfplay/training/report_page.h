// The parts that all reports share: style, the script that shows a game on a board, settings.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "engine/base/option.h"

namespace selfplay::training {

extern const std::string_view page_head, page_board, page_script, page_end;

// A line of a table for each: name, value, what it is.
std::string setting_lines(std::span<const engine::OptionRow> rows);

}  // namespace selfplay::training
