// Puts the moves of a position in the order of their priors.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/game.h"
#include "search/tree.h"

namespace search {

class PriorSorter {
   public:
    // Both by the priors, the highest first and equals as they were; one prior a move. Priors are
    // rounded to the 16 bits that the tree keeps of them.
    void sort(std::vector<float>& priors, engine::MoveList& moves) {
        keys_.resize(priors.size());
        for (std::size_t i = 0; i < priors.size(); ++i)
            keys_[i] = (0xffffu - pack_prior(priors[i])) << 16 | moves[static_cast<int>(i)].code;
        constexpr std::size_t few = 48;  // measured
        if (keys_.size() <= few)
            sort_few();
        else
            sort_many();
        moves.clear();
        for (std::size_t i = 0; i < keys_.size(); ++i) {
            moves.push({static_cast<std::uint16_t>(keys_[i])});
            priors[i] = unpack_prior(static_cast<std::uint16_t>(0xffffu - (keys_[i] >> 16)));
        }
    }

   private:
    void sort_few() {
        for (std::size_t i = 1; i < keys_.size(); ++i) {
            const auto key = keys_[i];
            std::size_t at = i;
            for (; at > 0 && keys_[at - 1] >> 16 > key >> 16; --at) keys_[at] = keys_[at - 1];
            keys_[at] = key;
        }
    }

    // A radix sort, in time proportional to the moves.
    void sort_many() {
        std::array<std::uint16_t, 256> low{}, high{};  // where the next key with this byte goes
        for (const auto key : keys_) {
            ++low[key >> 16 & 0xff];
            ++high[key >> 24];
        }
        to_places(low);
        to_places(high);
        turned_.resize(keys_.size());
        for (const auto key : keys_) turned_[low[key >> 16 & 0xff]++] = key;
        for (const auto key : turned_) keys_[high[key >> 24]++] = key;
    }

    // From how many keys have a byte to where the first of them goes.
    static void to_places(std::array<std::uint16_t, 256>& counts) {
        std::uint16_t place = 0;
        for (auto& count : counts) {
            const auto here = count;
            count = place;
            place = static_cast<std::uint16_t>(place + here);
        }
    }

    std::vector<std::uint32_t> keys_, turned_;  // complement of the prior above the move's code
};

}  // namespace search
