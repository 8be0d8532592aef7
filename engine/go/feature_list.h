// The features of all moves of a position, for those who train the linear policies.
#pragma once

#include <vector>

#include "engine/go/go.h"

namespace go {

// Of every legal move that fills no own eye, passes aside. Those of move i begin at starts[i] and
// end at starts[i + 1]; the first of them, up to rollout_ends[i], are the rollout policy's.
struct FeatureList {
    std::vector<Move> moves;
    std::vector<int> features, starts, rollout_ends;
};

// Overwrites the list.
void list_features(const Go& game, FeatureList& list);

}  // namespace go
