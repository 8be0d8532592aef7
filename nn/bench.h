// How fast networks run here: what `sanban bench nn` prints. Speeds are by the processor time of
// each thread, medians of several repeats, so that a shared machine gives figures that can be
// compared; the processor's peak is measured between the repeats.
#pragma once

#include <string>
#include <vector>

#include "engine/base/figure.h"
#include "nn/calibration.h"
#include "nn/executor.h"

namespace nn {

struct BenchSettings {
    int board = 9;
    Precision precision = Precision::int16;
    int threads = 1;
    int batch = 1;       // of the standard networks' positions
    double seconds = 1;  // for each network
};

// evals (of all threads), gflops, peak_share and, where oneDNN computes, ceiling_share (of bare
// convolutions of the same shapes), over these positions, one batch; in int8 also mixed_share: of
// the peak where what runs in bf16 there (first layer and heads) counts by the peak of bf16. Names
// begin with `prefix`. A precision that is lacking here gives way as compile says.
std::vector<engine::Figure> bench_network(const Graph& graph, const BenchSettings& settings,
                                          const Positions& positions,
                                          const Calibration& calibration,
                                          const std::string& prefix = "");

// The same for networks that builders make, in every precision that this machine has. The numbers
// that go in are random, mostly zeros as encoded positions are.
std::vector<engine::Figure> bench_standard_networks(const BenchSettings& settings);

}  // namespace nn
