// Rewrites of a graph that keep what it computes and make it cheaper to run. They are for
// executors: a file keeps the graph as it was trained.
#pragma once

#include "nn/graph.h"

namespace nn {

// Every batch norm becomes part of the convolution or dense layer before it when nothing else reads
// that layer, else an affine operation.
Graph fold_batch_norms(Graph graph);

// An activation, and an addition of a residual, become part of the operation before them.
Graph fuse(Graph graph);

// All of the above, and what no output needs is gone.
Graph optimise(Graph graph);

}  // namespace nn
