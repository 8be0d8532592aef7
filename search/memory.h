// Address space for large tables: zeroes, of which pages are taken as they are written to.
#pragma once

#include <cstddef>

namespace search {

class Memory {
   public:
    // `bytes`, or when the system grants no more, a half, a quarter … of them, down to `least`.
    // Fails with engine::Error when it grants not even that.
    Memory(std::size_t bytes, std::size_t least);
    Memory(const Memory&) = delete;
    Memory& operator=(const Memory&) = delete;
    ~Memory();

    std::byte* data() const { return data_; }
    std::size_t size() const { return size_; }

   private:
    std::byte* data_ = nullptr;
    std::size_t size_;
};

}  // namespace search
