// Rewrites of a graph that keep what it computes and make it cheaper to run. They are for
// executors: a file keeps the graph as it was trained.
#pragma once

#include "nn/graph.h"

namespace nn {

// What a batch norm divides a channel by.
double deviation(const Node& norm, std::size_t channel);

// Every batch norm becomes part of the convolution or dense layer before it when nothing else reads
// that layer, else an affine operation.
Graph fold_batch_norms(Graph graph);

// The way back, for a network that is to learn on: every convolution that an activation alone reads
// gets a batch norm in place of its bias. What it computes stays while the norm's statistics do;
// nn/training/norms.h gives it those of a batch.
Graph unfold_batch_norms(const Graph& graph);

// An activation, and an addition of a residual, become part of the operation before them.
Graph fuse(Graph graph);

// All of the above, and what no output needs is gone.
Graph optimise(Graph graph);

}  // namespace nn
