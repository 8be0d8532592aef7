// `sanban play` as a program of its own.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include "engine/base/files.h"
#include "selfplay/process.h"
#include "tests/temporary_folder.h"

namespace protocols {

namespace {

// What the file holds once it holds `text`; all that it held last when it never does.
std::string contents_with(const std::filesystem::path& path, const std::string& text) {
    std::string contents;
    for (int i = 0; i < 600; ++i) {
        if (std::filesystem::exists(path)) contents = engine::read_file(path);
        if (contents.find(text) != std::string::npos) break;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return contents;
}

}  // namespace

TEST(Play, TheRecordIsOnDiskWhileTheGameLasts) {
    const tests::TemporaryFolder folder;
    const auto record = folder.path() / "game.pgn";
    selfplay::Process program(
        std::string(SANBAN_EXECUTABLE) +
            " play --game chess --weights none --threads 1 --memory 16 --simulations 20 --save " +
            record.string(),
        {});
    const auto deadline = selfplay::Deadline::clock::now() + std::chrono::seconds(30);
    EXPECT_NE(contents_with(record, "*"), "");
    program.write_line("e2e4", deadline);
    EXPECT_NE(contents_with(record, "1. e4 ").find("1. e4 "), std::string::npos);
    program.write_line("resign", deadline);
    EXPECT_NE(contents_with(record, "0-1").find("[Result \"0-1\"]"), std::string::npos);
}

TEST(Play, SaysThatARecordCannotBeWritten) {
    selfplay::Process program(
        std::string(SANBAN_EXECUTABLE) +
            " play --weights none --threads 1 --memory 16 --simulations 20 --save /nowhere/a.sgf",
        {});
    const auto deadline = selfplay::Deadline::clock::now() + std::chrono::seconds(30);
    program.read_line(deadline);
    EXPECT_THROW(program.read_line(deadline), selfplay::Fault);
}

}  // namespace protocols
