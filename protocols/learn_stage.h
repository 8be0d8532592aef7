// The stages of AlphaGo's training as words behind `sanban learn`, and all of them as a preset of
// `sanban train`.
#pragma once

#include <optional>

#include "protocols/commands.h"

namespace protocols {

// Runs the stage that the first argument names, with the rest as its flags; nothing where it names
// none.
std::optional<int> run_learn_stage(Arguments arguments);

// Whether the flags of `sanban train` ask for AlphaGo's stages; and that, with these flags.
bool wants_alphago(Arguments arguments);
int run_train_alphago(Arguments arguments);

}  // namespace protocols
