// Where tests find data that is not part of the repository, if it is there.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace nn {

inline std::filesystem::path shared_data() {
    if (const char* folder = std::getenv("SANBAN_SHARED"))
        return std::filesystem::path(folder) / "data";
    return std::filesystem::path(SANBAN_SOURCE_DIR) / "../shared/data";
}

}  // namespace nn
