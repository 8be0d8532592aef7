#include <algorithm>
#include <array>

#include "engine/base/measure.h"
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
            double operations = 0;
            const double calls = engine::calls_per_second(
                0.01, [&] { operations = run_multiply_adds(precision, 10000); }, 1);
            auto& most = best[precision == Precision::bf16 ? 1 : 0];
            most = std::max(most, calls * operations);
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
