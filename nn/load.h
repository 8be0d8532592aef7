// Networks from files of any format we know, told apart by content and not by name.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "nn/calibration.h"
#include "nn/graph.h"

namespace nn {

// What comes out is valid. Fails with engine::Error, one line: what was expected, what was found.
Graph graph_from_bytes(std::string_view bytes);

// As above with the path in front of every message.
Graph load(const std::filesystem::path& path);

// What a file says of its network. Foreign ones, and older ones of ours, have no calibration.
struct Contents {
    Graph graph;
    Calibration calibration;
    std::string key;  // tells files of other content apart
};
Contents load_contents(const std::filesystem::path& path);
Contents contents_from_bytes(std::string_view bytes);

// Writes our own format; whatever fails, an old file stays whole.
void save(const Graph& graph, const std::filesystem::path& path,
          const Calibration& calibration = {});

}  // namespace nn
