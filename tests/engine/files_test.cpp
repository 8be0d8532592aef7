#include "engine/base/files.h"

#include <gtest/gtest.h>

#include <fstream>

#include "engine/base/error.h"

namespace engine {

namespace fs = std::filesystem;

class Files : public testing::Test {
   protected:
    Files() { fs::create_directories(folder); }
    ~Files() override { fs::remove_all(folder); }
    Files(const Files&) = delete;
    Files& operator=(const Files&) = delete;

    fs::path folder = fs::path(testing::TempDir()) /
                      testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(Files, ReadBackWhatWasWritten) {
    const std::string bytes("a\0b\r\n\xff", 6);
    write_file(folder / "x", bytes);
    EXPECT_EQ(read_file(folder / "x"), bytes);
    append_file(folder / "x", "more");
    EXPECT_EQ(read_file(folder / "x"), bytes + "more");
}

TEST_F(Files, LeaveNothingBesideTheFile) {
    write_file(folder / "x", "1");
    write_file(folder / "x", "2");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
}

TEST_F(Files, NameWhatIsMissingOrTooLarge) {
    write_file(folder / "x", std::string(100, 'a'));
    EXPECT_THROW(read_file(folder / "x", 99), Error);
    EXPECT_EQ(read_file(folder / "x", 100).size(), 100u);
    try {
        read_file(folder / "nowhere");
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("nowhere"), std::string::npos);
    }
    EXPECT_THROW(read_file(folder), Error);
}

TEST_F(Files, AFailedWriteKeepsTheOldFile) {
    // A full device accepts the file but not the bytes.
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    EXPECT_THROW(write_file("/dev/full", "x"), Error);
    EXPECT_THROW(write_file(folder / "no" / "folder", "x"), Error);
    write_file(folder / "kept", "old");
    fs::create_directory(folder / "target");
    write_file(folder / "target" / "inside", "x");
    EXPECT_THROW(write_file(folder / "target", "x"), Error);
    EXPECT_EQ(read_file(folder / "kept"), "old");
    EXPECT_EQ(read_file(folder / "target" / "inside"), "x");
}

}  // namespace engine
