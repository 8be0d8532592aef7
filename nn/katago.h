// KataGo's network files, versions 8 to 16, text or binary (already unpacked): their layout is
// written down beside KataGo's cpp/neuralnet/desc.cpp. Softmax order becomes ours (win, no result,
// loss), and the multipliers of the score outputs go into the weights. Of several policies the
// first is kept. Networks before version 8, those with a metadata encoder and transformers are
// refused by name.
#pragma once

#include <string_view>

#include "nn/graph.h"

namespace nn {

bool is_katago(std::string_view bytes);

// Fails with engine::Error; what it yields is valid.
Graph graph_from_katago(std::string_view bytes);

}  // namespace nn
