// Random numbers that explore: Dirichlet's for the priors at a root, Gumbel's for choosing without
// replacement. All from the caller's generator.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/base/random.h"

namespace search {

// In (0, 1).
double open_unit(engine::Random& random);

// Standard normal (Box & Muller 1958).
double normal(engine::Random& random);

// Standard Gumbel: location 0, scale 1.
float gumbel(engine::Random& random);

// Gamma distributed with shape `alpha` > 0 and scale 1 (Marsaglia & Tsang 2000).
double gamma(engine::Random& random, double alpha);

// `count` shares summing to 1, symmetrically Dirichlet distributed with concentration `alpha` > 0.
std::vector<float> dirichlet(engine::Random& random, std::size_t count, float alpha);

}  // namespace search
