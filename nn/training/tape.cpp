#include "nn/training/tape.h"

namespace nn::training {

namespace {

Eigen::Index row_count(const Tensor& tensor) { return tensor.shape[0]; }
Eigen::Index column_count(const Tensor& tensor) {
    return static_cast<Eigen::Index>(tensor.values.size()) / tensor.shape[0];
}

}  // namespace

Tape::Tape(const Graph& unfused, const Parameters& layout, int batch, int side)
    : graph(unfused),
      parameters(layout),
      size(batch),
      board(side),
      shapes(infer_shapes(unfused, side)),
      values(shapes.size()),
      gradients(shapes.size()),
      kept(shapes.size()) {}

void Tape::reserve(int n) {
    values[at(n)].resize(count(n));
    if (wants_gradient(n)) gradients[at(n)].resize(count(n));
}

ConstRows Tape::weight(int n, int w) const {
    const auto& tensor = node(n).weights[at(w)];
    return {weights.data() + parameters.offset(n, w), row_count(tensor), column_count(tensor)};
}

Rows Tape::weight_gradient(int n, int w) const {
    const auto& tensor = node(n).weights[at(w)];
    return {weight_gradients.data() + parameters.offset(n, w), row_count(tensor),
            column_count(tensor)};
}

}  // namespace nn::training
