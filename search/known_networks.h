// What was once found out about a network, kept in the user's cache folder so that it need not be
// found out again: its calibration, and which precision is the fastest that may be used. Nothing
// here ever fails: where there is no folder, or it cannot be written, nothing is remembered.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "nn/calibration.h"
#include "nn/executor.h"

namespace search {

struct KnownNetwork {
    nn::Calibration calibration;           // may be empty
    std::map<int, nn::Precision> fastest;  // by the board's side
};

// `key` tells the content of weight files apart. What it yields fits the graph and this processor;
// nothing known is empty.
KnownNetwork recall(const std::string& key, const nn::Graph& graph);
void remember(const std::string& key, const nn::Graph& graph, const KnownNetwork& known);

}  // namespace search
