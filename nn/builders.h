// New networks with random weights: the architectures of the family. What comes out is valid;
// equal descriptions and seeds give equal networks. Weights start as He et al. (2015) propose, and
// every last layer of a head near zero, so that policies start even and values at a draw.
#pragma once

#include <vector>

#include "engine/base/random.h"
#include "nn/graph.h"

namespace nn {

// How a policy head ends.
enum class PolicyHead : std::uint8_t {
    flat,    // 1x1 convolution, then a dense layer over the whole board (AlphaGo Zero)
    points,  // one logit a point, and a pass from pooled features: serves any board
    planes,  // a 3x3 convolution, then `move_planes` planes (AlphaZero's chess and shogi)
};

// What widens a residual block's view.
enum class Attention : std::uint8_t { none, squeeze_excitation, global_pooling };

struct TowerDescription {
    Facts facts;  // game, encoding, board, name, licence; blocks and channels are read from here
    int planes = 0, globals = 0;
    PolicyHead policy = PolicyHead::flat;
    int policy_size = 0;  // of a flat head
    int move_planes = 0;  // of a head of planes
    Attention attention = Attention::none;
    bool flat_value = true;  // a dense layer over the whole board; else pooled, for any board
    int value_width = 256;
    bool wdl = false;  // three logits rather than one number
    bool ownership = false, score = false, moves_left = false;
};

// Silver et al. 2017 and 2018: a convolution, residual blocks with batch norms, and heads. A board
// of 0 in the facts (any size) needs heads that serve any. Fails with engine::Error when they do
// not, or when a number is out of range.
Graph build_tower(const TowerDescription& description, engine::Random& random);

// Silver et al. 2016: 5x5, eleven 3x3 convolutions (`blocks` of the facts, where it is not 0, in
// all) and 1x1 to one plane with a bias per point; behind the points the pass, from the plane's
// mean.
Graph build_alphago_policy(const Facts& facts, int planes, engine::Random& random);
// The same convolutions, 1x1 to one plane, 256 ReLU, one tanh. `pooled`: 1x1 to so many planes
// instead, of which only the means over the board are looked at; far fewer weights, for who has
// fewer games than the paper's 30 million.
Graph build_alphago_value(const Facts& facts, int planes, engine::Random& random, int pooled = 0);

// Dense layers with ReLU between them over the input "globals"; widths from input to output. Its
// one output is "output".
Graph build_mlp(const Facts& facts, const std::vector<int>& widths, engine::Random& random);

}  // namespace nn
