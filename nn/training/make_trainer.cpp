#include "nn/training/trainer.h"

#if defined(SANBAN_ONEDNN)
#include "nn/training/onednn/trainer.h"
#endif

namespace nn::training {

std::unique_ptr<Trainer> make_trainer(const Graph& graph, [[maybe_unused]] Precision precision) {
#if defined(SANBAN_ONEDNN)
    return make_onednn_trainer(graph, precision);
#else
    return make_reference_trainer(graph);
#endif
}

}  // namespace nn::training
