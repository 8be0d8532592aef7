// The records and positions of ../shared that tests of shogi use where they are there.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace shogi {

// ../shared/data beside the sources, or under $SANBAN_SHARED.
inline std::filesystem::path shared_data() {
    const char* const shared = std::getenv("SANBAN_SHARED");
    return std::filesystem::path(shared ? shared : SANBAN_SOURCE_DIR "/../shared") / "data";
}

// Empty when the file is not there.
inline std::vector<std::string> lines_of(const std::filesystem::path& path) {
    std::vector<std::string> lines;
    std::ifstream in(path);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

}  // namespace shogi
