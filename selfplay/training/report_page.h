// The fixed parts of a report: its style, and the script that shows a game on a board.
#pragma once

#include <string_view>

namespace selfplay::training {

extern const std::string_view page_head, page_board, page_script, page_end;

}  // namespace selfplay::training
