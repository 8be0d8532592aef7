// What the linear policies of AlphaGo (Silver et al. 2016, extended data table 4) see of a move:
// each of these features is there or not, a number in [0, count). The rollout policy knows those
// before `self_atari`, the tree policy all. Patterns are the mover's, and the same however the
// board is turned. Where the paper lists every pattern met in its games, ours are numbered by
// hashes.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/go/board.h"

namespace go::features {

// The 3x3 colours around the move, in as many ways as symmetries leave.
inline constexpr int pattern = 0, pattern_count = 8740;
// Stones beside it that are in atari, see contact_feature.
inline constexpr int contact = pattern + pattern_count, contact_count = 18;
// Lines from the edge, where no stone is around: 1 and 2 (which patterns know), 3, 4, 5 or more.
inline constexpr int line = contact + contact_count, line_count = 5;
// Beside the last move, straight or diagonal; that it saves a chain put in atari, by extending it
// or by a capture.
inline constexpr int beside_last = line + line_count, beside_last_count = 2;
inline constexpr int save = beside_last + beside_last_count, save_count = 2;
// The diamond of 12 points around the last move, and which of them the move is.
inline constexpr int response = save + save_count, response_count = 32768;
// The shape of what the last move took, and where in it the move is.
inline constexpr int nakade = response + response_count, nakade_count = 8192;
inline constexpr int rollout_count = nakade + nakade_count;

inline constexpr int self_atari = rollout_count;
// dx + dy + max(dx, dy) from 2 to 17 or more, from the last move and the one before.
inline constexpr int distance_count = 16;
inline constexpr int last_distance = self_atari + 1;
inline constexpr int previous_distance = last_distance + distance_count;
// The diamond of 12 points around the move.
inline constexpr int diamond = previous_distance + distance_count, diamond_count = 65536;
inline constexpr int count = diamond + diamond_count;

// `captures`: 0 nothing, 1 a lone stone, 2 more; `saves`: an own chain in atari is beside it;
// `empty`: points beside it that are empty, 2 for more.
constexpr int contact_feature(int captures, bool saves, int empty) {
    return contact + (captures * 2 + (saves ? 1 : 0)) * 3 + empty;
}

// The feature of each of the 65536 surroundings that RolloutBoard tells, for Black to move; White's
// is that of the colours exchanged.
const std::vector<std::uint16_t>& patterns_of_black();
constexpr std::uint16_t colours_exchanged(std::uint16_t surroundings) {
    // 01 and 10 exchanged, 00 and 11 not.
    return static_cast<std::uint16_t>((surroundings & 0x5555) << 1 | (surroundings & 0xaaaa) >> 1);
}

struct Offset {
    int dx = 0, dy = 0;
};
inline constexpr int diamond_points = 12;
inline constexpr std::array<Offset, diamond_points> diamond_offsets{{{0, -1},
                                                                     {-1, 0},
                                                                     {1, 0},
                                                                     {0, 1},
                                                                     {-1, -1},
                                                                     {1, -1},
                                                                     {-1, 1},
                                                                     {1, 1},
                                                                     {0, -2},
                                                                     {-2, 0},
                                                                     {2, 0},
                                                                     {0, 2}}};

// A diamond under all eight symmetries at once.
class Diamond {
   public:
    // `colour`: 0 empty, 1 the mover's, 2 the opponent's, 3 beyond the edge.
    void add(int point, int colour);
    // Then all points have been added.
    void settle();
    int feature() const;                    // of the diamond as it is: around the move
    int response_feature(int point) const;  // the move being at that one of its points

   private:
    std::array<std::uint32_t, 8> hashes_{};
    std::uint32_t least_ = 0;
    unsigned symmetries_ = 0;  // bits: those that yield the least
};

// Of `points` of a shape, relative to the move.
int nakade_feature(const std::vector<Offset>& points);

}  // namespace go::features
