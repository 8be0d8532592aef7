// Golden transcripts of GTP: in tests/protocols/gtp/*.txt every line after "> " is said to an
// engine on 9x9, and the lines up to the next one are all that it writes, blanks at their ends
// and blank lines apart.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/protocols/gtp_guest.h"

namespace protocols {

namespace {

std::string without_blanks(const std::string& text) {
    std::istringstream in(text);
    std::string result;
    for (std::string line; std::getline(in, line);) {
        while (line.ends_with(' ')) line.pop_back();
        if (!line.empty()) result += line + "\n";
    }
    return result;
}

class GtpTranscript : public testing::TestWithParam<std::string> {};

std::vector<std::string> transcripts() {
    std::vector<std::string> names;
    for (const auto& file :
         std::filesystem::directory_iterator(SANBAN_SOURCE_DIR "/tests/protocols/gtp"))
        names.push_back(file.path().stem().string());
    return names;
}

}  // namespace

TEST_P(GtpTranscript, IsAnsweredAsWritten) {
    std::ifstream in(SANBAN_SOURCE_DIR "/tests/protocols/gtp/" + GetParam() + ".txt");
    GtpGuest guest;
    std::string said, expected;
    int exchanges = 0;
    const auto check = [&] {
        if (said.empty()) return;
        EXPECT_EQ(without_blanks(guest.raw(said)), without_blanks(expected)) << "> " << said;
        ++exchanges;
    };
    for (std::string line; std::getline(in, line);) {
        if (!line.starts_with("> ")) {
            expected += line + "\n";
            continue;
        }
        check();
        said = line.substr(2);
        expected.clear();
    }
    check();
    EXPECT_GT(exchanges, 4);
}

INSTANTIATE_TEST_SUITE_P(Files, GtpTranscript, testing::ValuesIn(transcripts()),
                         [](const auto& file) { return file.param; });

}  // namespace protocols
