#include "selfplay/training/lecture.h"

#include "selfplay/records/files_behind.h"

namespace selfplay::training {

namespace fs = std::filesystem;

std::vector<fs::path> record_files(std::span<const fs::path> paths) {
    return records::files_behind<fs::directory_iterator>(
        paths, [](const auto& entry) { return entry.path().extension() == ".games"; });
}

}  // namespace selfplay::training
