#include "nn/training/operations.h"

namespace nn::training {

Rule rule_of(Operation operation) {
    switch (operation) {
        case Operation::input:
            return {[](Tape&, int) {}, [](Tape&, int) {}};
        case Operation::convolution:
            return convolution_rule();
        case Operation::dense:
            return dense_rule();
        case Operation::batch_norm:
            return batch_norm_rule();
        case Operation::affine:
            return affine_rule();
        case Operation::activation:
            return activation_rule();
        case Operation::add:
            return add_rule();
        case Operation::add_vector:
            return add_vector_rule();
        case Operation::pool:
            return pool_rule();
        case Operation::squeeze_scale:
            return squeeze_scale_rule();
        case Operation::flatten:
            return flatten_rule();
        case Operation::concatenate:
            return concatenate_rule();
        case Operation::gather:
            return gather_rule();
        case Operation::point_bias:
            return point_bias_rule();
    }
    return {};
}

}  // namespace nn::training
