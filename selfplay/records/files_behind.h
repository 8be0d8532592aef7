// The files that a user means by naming files and folders.
#pragma once

#include <algorithm>
#include <filesystem>
#include <span>
#include <vector>

#include "engine/base/error.h"

namespace selfplay::records {

// The paths in their order, a folder standing for those of its files, sorted, that are `wanted`.
// Iterator is std::filesystem's: over the folder alone or all that is below it. Fails with
// engine::Error on a path that is not there.
template <class Iterator, class Wanted>
std::vector<std::filesystem::path> files_behind(std::span<const std::filesystem::path> paths,
                                                Wanted wanted) {
    namespace fs = std::filesystem;
    std::vector<fs::path> files;
    for (const auto& path : paths) {
        if (!fs::exists(path)) engine::fail("{}: there is no such file or folder", path.string());
        if (!fs::is_directory(path)) {
            files.push_back(path);
            continue;
        }
        const auto first = static_cast<std::ptrdiff_t>(files.size());
        for (const auto& entry : Iterator(path))
            if (wanted(entry)) files.push_back(entry.path());
        std::sort(files.begin() + first, files.end());
    }
    return files;
}

}  // namespace selfplay::records
