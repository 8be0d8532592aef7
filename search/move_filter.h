// Which moves at the root a search may take: all, or some. Known by their codes alone.
#pragma once

#include <bitset>
#include <span>

#include "engine/game.h"

namespace search {

class MoveFilter {
   public:
    // All but `avoid`, and of `only` alone unless that is empty.
    void restrict(std::span<const engine::Move> only, std::span<const engine::Move> avoid) {
        if (only.empty())
            barred_.reset();
        else
            barred_.set();
        for (const auto move : only) barred_.reset(move.code);
        for (const auto move : avoid) barred_.set(move.code);
    }
    bool operator()(engine::Move move) const { return !barred_[move.code]; }

   private:
    std::bitset<65536> barred_;
};

}  // namespace search
