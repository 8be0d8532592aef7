// What the processor can do at most: multiply-adds in registers, by the widest instruction it has
// for a number format. The measure that speeds of networks are quoted against.
#pragma once

#include <cstdint>

#include "nn/executor.h"

namespace nn {

// Runs `rounds` rounds of independent multiply-adds on the caller's thread; yields how many
// operations that was (a multiplication with its addition counts two). 0 where the format has no
// instruction here.
double run_multiply_adds(Precision precision, std::int64_t rounds);

// Operations a second of these, over about so many seconds of the calling thread's time.
double peak_rate(Precision precision, double seconds);

}  // namespace nn
