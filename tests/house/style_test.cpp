// What the house asks of every source file and a machine can see. (Formatting is clang-format's,
// the length of functions clang-tidy's.)
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <regex>
#include <string>
#include <vector>

#include "engine/base/files.h"

namespace {

namespace fs = std::filesystem;

const fs::path top = SANBAN_SOURCE_DIR;

std::vector<fs::path> sources() {
    std::vector<fs::path> found;
    for (const auto* const folder : {"engine", "nn", "search", "selfplay", "protocols", "tests"}) {
        if (!fs::exists(top / folder)) continue;
        for (const auto& entry : fs::recursive_directory_iterator(top / folder)) {
            const auto extension = entry.path().extension();
            if (extension == ".h" || extension == ".cpp") found.push_back(entry.path());
        }
    }
    return found;
}

// The files in which `bad` is true of the text, below the top folder.
std::vector<std::string> offenders(
    const std::function<bool(const fs::path&, const std::string&)>& bad) {
    std::vector<std::string> found;
    for (const auto& path : sources())
        if (bad(path, engine::read_file(path))) found.push_back(fs::relative(path, top).string());
    return found;
}

using Nothing = std::vector<std::string>;

TEST(Style, ThereAreSources) { EXPECT_GT(sources().size(), 50u); }

TEST(Style, HeadersOpenWithAWordOnThemselves) {
    EXPECT_EQ(offenders([](const fs::path& path, const std::string& text) {
                  return path.extension() == ".h" &&
                         (!text.starts_with("//") || text.find("\n#pragma once\n") == text.npos);
              }),
              Nothing{});
}

TEST(Style, NoTabsNoCarriageReturnsAndALastLineThatEnds) {
    EXPECT_EQ(offenders([](const fs::path&, const std::string& text) {
                  return text.find_first_of("\t\r") != text.npos || !text.ends_with('\n');
              }),
              Nothing{});
}

TEST(Style, NothingLeftToDo) {
    // In two pieces, or this file would be the offender.
    const std::regex marks(std::string("\\b(TO") + "DO|FIX" + "ME)\\b");
    EXPECT_EQ(offenders([&](const fs::path&, const std::string& text) {
                  return std::regex_search(text, marks);
              }),
              Nothing{});
}

TEST(Style, NoMacrosAndNoFriends) {
    EXPECT_EQ(offenders([](const fs::path&, const std::string& text) {
                  return text.find("\n#define ") != text.npos ||
                         text.find("\n    friend ") != text.npos;
              }),
              Nothing{});
}

}  // namespace
