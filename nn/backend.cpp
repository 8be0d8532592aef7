#include "nn/backend.h"

#include <cassert>

#include "nn/eigen/executor.h"
#include "nn/passes.h"
#include "nn/winograd/winograd.h"
#if defined(SANBAN_ONEDNN)
#include "nn/onednn/executor.h"
#endif

namespace nn {

namespace {

bool library_serves([[maybe_unused]] Precision precision) {
#if defined(SANBAN_ONEDNN)
    return onednn::serves(precision);
#else
    return false;
#endif
}

bool served(const Graph& graph, Precision precision, int board) {
    if (precision == Precision::fp32) return true;
    if (precision != Precision::int16) return library_serves(precision);
    return winograd::available() && winograd::serves(optimise(graph), board);
}

}  // namespace

std::string_view why_not(const Graph& graph, Precision precision, int board) {
    constexpr std::string_view slow_processor = "the processor has no instructions for it";
    if (served(graph, precision, board)) return {};
    if (precision == Precision::int16)
        return winograd::available() ? "the network is none that it serves" : slow_processor;
#if defined(SANBAN_ONEDNN)
    return slow_processor;
#else
    return "this build is without oneDNN";
#endif
}

Precision served_precision(const Graph& graph, Precision wanted, int board) {
    while (!served(graph, wanted, board))
        wanted = static_cast<Precision>(static_cast<int>(wanted) - 1);
    return wanted;
}

std::unique_ptr<Program> compile(const Graph& graph, Precision precision,
                                 const Calibration& calibration, int board) {
    const auto served = served_precision(graph, precision, board);
    assert(served < Precision::int8 || !calibration.maxima.empty());
    if (served == Precision::int16)
        return std::make_unique<winograd::Program>(optimise(graph), calibration.maxima, board);
#if defined(SANBAN_ONEDNN)
    return std::make_unique<onednn::Program>(graph, served, calibration);
#else
    return std::make_unique<eigen::Program>(graph);
#endif
}

}  // namespace nn
