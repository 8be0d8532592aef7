// A trained network inside a larger one, which at first computes what the small one does: learning
// goes on with more room instead of beginning anew (Net2Net, Chen et al. 2016, with zeros in place
// of copies, so that nothing needs noise to become different).
#pragma once

#include <optional>

#include "nn/graph.h"

namespace nn {

// `large`, a new network, with the weights of `small` in its first channels and blocks. What is new
// keeps its own random weights, but nothing old reads it yet, and a new block adds nothing: its
// last batch norm begins with a scale of zero. Steps and licence are the small one's. Nothing when
// `small` is not the same design with fewer blocks or channels, or is one that cannot grow.
std::optional<Graph> grown(const Graph& small, Graph large);

}  // namespace nn
