// Winograd's minimal filtering F(m x m, 3x3) (Lavin & Gray 2015) as matrices, and what it allows
// int16 arithmetic: how large inputs may be so that their transforms stay exact.
#pragma once

#include <array>

namespace nn::winograd {

// Y = A^T [(G g G^T) . (B^T d B)] A; the transforms of kernels.h compute with B and A.
struct Tiling {
    int tile = 0;                                 // m: outputs a side
    std::array<std::array<int, 6>, 6> input;      // B^T
    std::array<std::array<double, 3>, 6> kernel;  // G
    std::array<std::array<int, 6>, 4> output;     // A^T

    int side() const { return tile + 2; }
    int cells() const { return side() * side(); }

    // The largest |value| that a transformed input can take at a cell, for inputs in [-low, high].
    double gain(int cell, double low, double high) const;
    // Inputs of up to so many steps are transformed without overflow: 480 (F4), 1820 (F3) and 8191
    // (F2) when none is negative, as after a ReLU. B^T d B of F4 multiplies by up to 68 then, by
    // 100 otherwise, and must stay under 2^15.
    int limit(bool negative) const;
};

// m is 2, 3 or 4.
const Tiling& tiling(int tile);

// Fewest multiplications on this board: large tiles save more in their inside and waste more over
// the border. 4 at 19x19, 13x13 and 8x8, 3 at 9x9.
int best_tile(int board);

}  // namespace nn::winograd
