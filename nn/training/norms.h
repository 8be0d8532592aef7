// Batch norms for a network that learned without them, or whose statistics are of other positions.
#pragma once

#include "nn/training/learner.h"

namespace nn::training {

// Every batch norm gets the mean and variance that it meets in these samples, and the scale and
// shift with which the network computes what it computed by its running statistics before. Fails
// with engine::Error on settings that cannot be.
Graph fit_norms(Graph graph, const Samples& samples, const LearnerSettings& settings);

}  // namespace nn::training
