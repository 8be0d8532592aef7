// Every operation of the graph, forward and backward, in fp32 by Eigen: the reference that faster
// trainers are compared with, and what they fall back on. Each pair stands side by side in a file
// of its kind.
#pragma once

#include "nn/training/tape.h"

namespace nn::training {

// forward fills the value of node `n` from those of its inputs; backward adds to the gradients of
// its inputs and weights what its own gradient implies, after a forward of the same tape.
struct Rule {
    void (*forward)(Tape& tape, int n);
    void (*backward)(Tape& tape, int n);
};

Rule rule_of(Operation operation);

Rule convolution_rule();
Rule dense_rule();
Rule batch_norm_rule();
Rule affine_rule();
Rule activation_rule();
Rule add_rule();
Rule add_vector_rule();
Rule point_bias_rule();
Rule pool_rule();
Rule squeeze_scale_rule();
Rule flatten_rule();
Rule concatenate_rule();
Rule gather_rule();

}  // namespace nn::training
