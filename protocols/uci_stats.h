// What lc0 prints under VerboseMoveStats, for tools that read it: one line a root move, the best
// last, then one of the root.
#pragma once

#include <string>
#include <vector>

#include "protocols/session.h"

namespace protocols {

std::vector<std::string> verbose_stats(const Session& session, const search::Analysis& picture);

}  // namespace protocols
