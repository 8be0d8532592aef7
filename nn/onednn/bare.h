// The convolutions of a network and nothing else, one after another on memory of their own: the
// ceiling that a whole network is measured against.
#pragma once

#include "nn/calibration.h"
#include "nn/onednn/layer.h"
#include "nn/onednn/layout.h"
#include "nn/onednn/library.h"

namespace nn::onednn {

class BareConvolutions {
   public:
    // For the board and number of `positions`. Run it on the thread that made it.
    BareConvolutions(const Graph& graph, Precision precision, const Calibration& calibration,
                     const Positions& positions);
    // Yields for how many positions it ran.
    double run() const;
    // Of the operations that a position takes, those in int8.
    double int8_operations() const { return int8_operations_; }

   private:
    void add(std::size_t node);

    Layout layout_;
    int positions_;
    double int8_operations_ = 0;
    dnnl::stream stream_;
    PackedWeights packed_;
    std::vector<Bytes> buffers_;
    std::vector<Layer> layers_;
};

}  // namespace nn::onednn
