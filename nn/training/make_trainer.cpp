#include <algorithm>
#include <array>

#include "nn/peak.h"
#include "nn/training/trainer.h"

#if defined(SANBAN_ONEDNN)
#include "nn/training/onednn/trainer.h"
#endif

namespace nn::training {

namespace {

Precision measured() {
    // In turns, and the best of each: others may have the core for a while.
    std::array<double, 2> best{};
    for (int turn = 0; turn < 5; ++turn)
        for (const auto precision : {Precision::fp32, Precision::bf16}) {
            auto& most = best[precision == Precision::bf16 ? 1 : 0];
            most = std::max(most, peak_rate(precision, 0.01));
        }
    return best[1] > best[0] ? Precision::bf16 : Precision::fp32;
}

}  // namespace

Precision faster_precision() {
    static const auto faster = measured();
    return faster;
}

std::unique_ptr<Trainer> make_trainer(const Graph& graph, [[maybe_unused]] Precision precision) {
#if defined(SANBAN_ONEDNN)
    return make_onednn_trainer(graph, precision);
#else
    return make_reference_trainer(graph);
#endif
}

}  // namespace nn::training
