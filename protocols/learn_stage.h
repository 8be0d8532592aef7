// The stages of AlphaGo's training as words behind `sanban learn`, and as a preset of `sanban
// train`.
#pragma once

#include <optional>

#include "protocols/commands.h"

namespace protocols {

// Runs the stage that the first argument names, with the rest as its flags; nothing where it names
// none.
std::optional<int> run_learn_stage(Arguments arguments);
// Runs all of them for flags of `sanban train` that say `--preset alphago`; nothing for others.
std::optional<int> run_alphago_training(Arguments arguments);

}  // namespace protocols
