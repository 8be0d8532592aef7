// How fast a network of a file is in play: what `sanban bench nn --weights` prints.
#pragma once

#include <string>
#include <vector>

#include "nn/bench.h"
#include "search/network.h"

namespace search {

// The figures of nn::bench_network over positions from games of the network with itself, and
// encoding_share: what part of an evaluation is spent on encoding the position and gathering the
// policy. A board of 0 is the network's own, 19 where it serves any in Go. Fails as load_network.
std::vector<engine::Figure> bench_weights(const std::string& name, PrecisionChoice choice,
                                          nn::BenchSettings settings);

}  // namespace search
