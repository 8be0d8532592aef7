// Leela Zero's text weights (already unpacked), version 1, and version 2 whose value is Black's
// (ELF OpenGo). The layout is that of Leela Zero's Network.cpp.
#pragma once

#include <string_view>

#include "nn/graph.h"

namespace nn {

bool is_leela_zero(std::string_view bytes);

// Fails with engine::Error; what it yields is valid. A value that is Black's gets an encoding of
// its own, "leela-zero-18-black".
Graph graph_from_leela_zero(std::string_view bytes);

}  // namespace nn
