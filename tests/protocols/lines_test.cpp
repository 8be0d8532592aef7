#include "protocols/lines.h"

#include <gtest/gtest.h>

#include <sstream>

namespace protocols {

TEST(Lines, DropControlCharactersAndSayWhatIsTooLong) {
    std::istringstream in(std::string("a\0b\r\tc\n", 7) + std::string(20, 'x') + "\nlast");
    Line line;
    ASSERT_TRUE(read_line(in, line, 10));
    EXPECT_EQ(line.text, "ab c");
    EXPECT_FALSE(line.too_long);
    ASSERT_TRUE(read_line(in, line, 10));
    EXPECT_TRUE(line.too_long);
    EXPECT_EQ(line.text.size(), 10u);
    ASSERT_TRUE(read_line(in, line, 10));
    EXPECT_EQ(line.text, "last");
    EXPECT_FALSE(read_line(in, line, 10));
}

}  // namespace protocols
