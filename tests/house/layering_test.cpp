// Reads every #include of the product: none may point up the layers, and no game may know another.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path top = SANBAN_SOURCE_DIR;

// What each folder may include besides itself.
const std::map<std::string, std::set<std::string>> below = {
    {"engine", {}},
    {"nn", {"engine/base"}},
    {"search", {"engine", "nn"}},
    {"selfplay", {"engine", "nn", "search"}},
    {"protocols", {"engine", "nn", "search", "selfplay"}},
};

struct Include {
    std::string from, to;  // paths below the top folder
};

std::vector<Include> includes_of(const fs::path& file) {
    std::vector<Include> found;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        constexpr std::string_view start = "#include \"";
        if (line.starts_with(start))
            found.push_back({fs::relative(file, top).string(),
                             line.substr(start.size(), line.rfind('"') - start.size())});
    }
    return found;
}

std::vector<Include> all_includes() {
    std::vector<Include> all;
    for (const auto& [layer, lower] : below) {
        if (!fs::exists(top / layer)) continue;
        for (const auto& entry : fs::recursive_directory_iterator(top / layer)) {
            const auto extension = entry.path().extension();
            if (extension != ".h" && extension != ".cpp") continue;
            for (const auto& include : includes_of(entry.path())) all.push_back(include);
        }
    }
    return all;
}

std::string first_folder(const std::string& path) { return path.substr(0, path.find('/')); }

bool within(const std::string& path, const std::string& folder) {
    return path.starts_with(folder + "/");
}

// "go" for engine/go/board.h; empty for what all games share.
std::string game_folder(const std::string& path) {
    const fs::path parts(path);
    if (first_folder(path) != "engine" || std::distance(parts.begin(), parts.end()) < 3) return {};
    const auto folder = std::next(parts.begin())->string();
    return folder == "base" ? "" : folder;
}

TEST(Layering, NoIncludePointsUp) {
    const auto includes = all_includes();
    ASSERT_GT(includes.size(), 20u);
    for (const auto& [from, to] : includes) {
        const auto layer = first_folder(from);
        bool allowed = within(to, layer);
        for (const auto& lower : below.at(layer)) allowed = allowed || within(to, lower);
        EXPECT_TRUE(allowed) << from << " includes " << to;
    }
}

TEST(Layering, BaseStandsAlone) {
    for (const auto& [from, to] : all_includes()) {
        if (within(from, "engine/base")) {
            EXPECT_TRUE(within(to, "engine/base")) << from << " includes " << to;
        }
    }
}

TEST(Layering, GamesDoNotKnowEachOther) {
    for (const auto& [from, to] : all_includes()) {
        if (game_folder(from).empty()) continue;
        EXPECT_TRUE(game_folder(to).empty() || game_folder(to) == game_folder(from))
            << from << " includes " << to;
    }
}

TEST(Layering, EveryIncludeNamesAFile) {
    for (const auto& [from, to] : all_includes())
        EXPECT_TRUE(fs::exists(top / to) || to.ends_with(".pb.h")) << from << " includes " << to;
}

}  // namespace
