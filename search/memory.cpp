#include "search/memory.h"

#include <sys/mman.h>

#include "engine/base/error.h"

namespace search {

namespace {

std::byte* map(std::size_t bytes) {
    void* memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                          MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    return memory == MAP_FAILED ? nullptr : static_cast<std::byte*>(memory);
}

}  // namespace

Memory::Memory(std::size_t bytes, std::size_t least) : size_(bytes) {
    while (!(data_ = map(size_)) && size_ / 2 >= least) size_ /= 2;
    if (!data_) engine::fail("out of memory: cannot reserve {} bytes for the search", size_);
    // Searches jump about in it: small pages would cost a fault and a walk of the tables each time.
    ::madvise(data_, size_, MADV_HUGEPAGE);
}

Memory::~Memory() { ::munmap(data_, size_); }

}  // namespace search
