#include "selfplay/training/lecture.h"

#include <algorithm>

namespace selfplay::training {

namespace fs = std::filesystem;

std::vector<fs::path> record_files(std::span<const fs::path> paths) {
    std::vector<fs::path> files;
    for (const auto& path : paths) {
        if (!fs::exists(path)) engine::fail("{}: there is no such file or folder", path.string());
        if (!fs::is_directory(path)) {
            files.push_back(path);
            continue;
        }
        const auto first = static_cast<std::ptrdiff_t>(files.size());
        for (const auto& entry : fs::directory_iterator(path))
            if (entry.path().extension() == ".games") files.push_back(entry.path());
        std::sort(files.begin() + first, files.end());
    }
    return files;
}

}  // namespace selfplay::training
