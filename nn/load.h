// Networks from files of any format we know, told apart by content and not by name.
#pragma once

#include <filesystem>
#include <string_view>

#include "nn/graph.h"

namespace nn {

// What comes out is valid. Fails with engine::Error, one line: what was expected, what was found.
Graph graph_from_bytes(std::string_view bytes);

// As above with the path in front of every message.
Graph load(const std::filesystem::path& path);

// Writes our own format; whatever fails, an old file stays whole.
void save(const Graph& graph, const std::filesystem::path& path);

}  // namespace nn
