// Time controls as the user writes them, in the words of KataGo's kata-time_settings.
#pragma once

#include <string_view>

#include "search/clock.h"

namespace selfplay {

// "none", "absolute MAIN", "byoyomi MAIN PERIOD PERIODS", "canadian MAIN PERIOD STONES",
// "fischer MAIN INCREMENT", "session MAIN MOVES [INCREMENT]" (chess: MAIN anew every MOVES moves),
// "move TIME" (each move on its own). Seconds, fractions allowed. Fails with engine::Error.
search::TimeControl time_from_text(std::string_view text);

}  // namespace selfplay
