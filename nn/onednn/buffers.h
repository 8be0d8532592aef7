// Memory for intermediate results of one stage: what is given back is taken again, the smallest
// that fits first, so that a stage stays in the cache. All freed with the object.
#pragma once

#include <map>
#include <vector>

#include "nn/onednn/library.h"

namespace nn::onednn {

class Buffers {
   public:
    std::byte* take(std::size_t size) {
        auto found = free_.lower_bound(size);
        if (found == free_.end()) {
            all_.push_back(allocate(size));
            sizes_[all_.back().get()] = size;
            return all_.back().get();
        }
        auto* const bytes = found->second;
        free_.erase(found);
        return bytes;
    }
    void give_back(std::byte* bytes) { free_.emplace(sizes_.at(bytes), bytes); }

   private:
    std::vector<Bytes> all_;
    std::map<std::byte*, std::size_t> sizes_;
    std::multimap<std::size_t, std::byte*> free_;
};

}  // namespace nn::onednn
