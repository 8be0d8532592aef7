// The beginnings that the games of a match are played from: drawn from a file in an order that the
// seed decides, or made of random legal moves. The same settings give the same openings.
#pragma once

#include <vector>

#include "selfplay/match.h"

namespace selfplay {

class Openings {
   public:
    // Fails with engine::Error on a file that holds none.
    Openings(const OpeningSettings& settings, const Rulebook& rulebook);

    // Of the `number`th pair of games; a file's openings come round again when used up.
    Opening at(int number) const;

   private:
    Opening random(int number) const;

    OpeningSettings settings_;
    const Rulebook& rulebook_;
    std::vector<Opening> book_;
};

}  // namespace selfplay
