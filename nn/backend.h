// The one place that knows which ways of computing there are: picks the fastest that this build
// and this processor have. Who runs networks asks here and names no library.
#pragma once

#include <string_view>

#include "nn/calibration.h"
#include "nn/program.h"

namespace nn {

// What `wanted` becomes here: a number format that the build or the processor lacks gives way to
// the next more exact one, fp32 at last.
Precision served_precision(const Graph& graph, Precision wanted, int board);

// Why `precision` is not served, for users: what the build, the processor or the network lacks.
// Empty where it is.
std::string_view why_not(const Graph& graph, Precision precision, int board);

// `graph` must be valid; `board` is the side that speed matters on (others are served too, where
// the network serves them). int8 and int16 need a calibration of this graph.
std::unique_ptr<Program> compile(const Graph& graph, Precision precision,
                                 const Calibration& calibration, int board);

}  // namespace nn
