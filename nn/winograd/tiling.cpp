#include "nn/winograd/tiling.h"

#include <algorithm>
#include <cstdlib>

namespace nn::winograd {

namespace {

constexpr double third = 1.0 / 3, sixth = 1.0 / 6;

constexpr Tiling two = {2,
                        {{{1, 0, -1, 0}, {0, 1, 1, 0}, {0, -1, 1, 0}, {0, 1, 0, -1}}},
                        {{{1, 0, 0}, {0.5, 0.5, 0.5}, {0.5, -0.5, 0.5}, {0, 0, 1}}},
                        {{{1, 1, 1, 0}, {0, 1, -1, -1}}}};
constexpr Tiling three = {
    3,
    {{{2, -1, -2, 1, 0}, {0, -2, -1, 1, 0}, {0, 2, -3, 1, 0}, {0, -1, 0, 1, 0}, {0, 2, -1, -2, 1}}},
    {{{0.5, 0, 0},
      {-0.5, -0.5, -0.5},
      {-sixth, sixth, -sixth},
      {sixth, third, 2 * third},
      {0, 0, 1}}},
    {{{1, 1, 1, 1, 0}, {0, 1, -1, 2, 0}, {0, 1, 1, 4, 1}}}};
constexpr Tiling four = {
    4,
    {{{4, 0, -5, 0, 1, 0},
      {0, -4, -4, 1, 1, 0},
      {0, 4, -4, -1, 1, 0},
      {0, -2, -1, 2, 1, 0},
      {0, 2, -1, -2, 1, 0},
      {0, 4, 0, -5, 0, 1}}},
    {{{0.25, 0, 0},
      {-sixth, -sixth, -sixth},
      {-sixth, sixth, -sixth},
      {0.25 * sixth, 0.5 * sixth, sixth},
      {0.25 * sixth, -0.5 * sixth, sixth},
      {0, 0, 1}}},
    {{{1, 1, 1, 1, 1, 0}, {0, 1, -1, 2, -2, 0}, {0, 1, 1, 4, 4, 0}, {0, 1, -1, 8, -8, 1}}}};

struct Sums {
    int positive = 0, negative = 0;
};

Sums sums_of(const std::array<int, 6>& row) {
    Sums sums;
    for (const int factor : row) (factor > 0 ? sums.positive : sums.negative) += std::abs(factor);
    return sums;
}

}  // namespace

double Tiling::gain(int cell, double low, double high) const {
    const auto down = sums_of(input[static_cast<std::size_t>(cell / side())]);
    const auto along = sums_of(input[static_cast<std::size_t>(cell % side())]);
    const int plus = down.positive * along.positive + down.negative * along.negative;
    const int minus = down.positive * along.negative + down.negative * along.positive;
    return std::max(plus * high + minus * low, minus * high + plus * low);
}

int Tiling::limit(bool negative) const {
    double most = 0;
    for (int cell = 0; cell < cells(); ++cell)
        most = std::max(most, gain(cell, negative ? 1 : 0, 1));
    // A half for rounding: -32768 exists, 32768 does not.
    return static_cast<int>((32767 - 0.5) / most);
}

const Tiling& tiling(int tile) { return tile == 2 ? two : tile == 3 ? three : four; }

int best_tile(int board) {
    const auto cost = [board](int tile) {
        const int tiles = (board + tile - 1) / tile;
        return tiles * tiles * tiling(tile).cells();
    };
    int best = 2;
    for (const int tile : {3, 4})
        if (cost(tile) < cost(best)) best = tile;
    return best;
}

}  // namespace nn::winograd
