// Strengths of many players from the games between them, on the Elo scale: the likeliest ones under
// the model of Bradley and Terry (a draw is half a win), with a broad prior that keeps them finite.
// Pure functions.
#pragma once

#include <span>
#include <vector>

#include "selfplay/rating.h"

namespace selfplay::training {

// Between players a and b, as a sees it.
struct Pairing {
    std::size_t a = 0, b = 0;
    Tally tally;
};

// What is believed of a player before any game.
struct Belief {
    double elo = 0, deviation = 400;
};

struct Strength {
    double elo = 0, deviation = 0;  // one standard deviation, of the difference to player 0
};

// One for each of `beliefs`; player 0 stands at its believed Elo. `pairings` name players by their
// index there.
std::vector<Strength> strengths(std::span<const Belief> beliefs, std::span<const Pairing> pairings);

}  // namespace selfplay::training
