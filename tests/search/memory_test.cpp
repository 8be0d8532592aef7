#include "search/memory.h"

#include <gtest/gtest.h>

#include "engine/base/error.h"

namespace search {
namespace {

TEST(Memory, IsZeroAndMayBeWritten) {
    const Memory memory(1 << 20, 1 << 20);
    EXPECT_EQ(memory.size(), std::size_t{1} << 20);
    EXPECT_EQ(memory.data()[12345], std::byte{0});
    memory.data()[memory.size() - 1] = std::byte{7};
    EXPECT_EQ(memory.data()[memory.size() - 1], std::byte{7});
}

// More than the address space has.
TEST(Memory, TakesLessWhereThereIsNoMore) {
    const Memory memory(std::size_t{1} << 60, 1 << 20);
    EXPECT_LT(memory.size(), std::size_t{1} << 48);
    EXPECT_GE(memory.size(), std::size_t{1} << 20);
}

TEST(Memory, FailsWhereThereIsNotEvenTheLeast) {
    EXPECT_THROW(Memory(std::size_t{1} << 60, std::size_t{1} << 59), engine::Error);
}

}  // namespace
}  // namespace search
