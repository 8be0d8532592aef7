// The stages of AlphaGo's training as words behind `sanban learn`.
#pragma once

#include <optional>

#include "protocols/commands.h"

namespace protocols {

// Runs the stage that the first argument names, with the rest as its flags; nothing where it names
// none.
std::optional<int> run_learn_stage(Arguments arguments);

}  // namespace protocols
