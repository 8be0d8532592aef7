// Whole files in and out. Every failure is an engine::Error that names the path.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace engine {

// Fails on files larger than `most` bytes.
std::string read_file(const std::filesystem::path& path, std::size_t most = std::size_t{1} << 30);

// The program's own folder of a kind: below what the environment variable names, else below a place
// in the user's home; none where there is no home.
std::optional<std::filesystem::path> user_folder(const char* variable, const char* in_home);

// Writes beside `path`, syncs, renames: whatever fails, the old file stays whole.
void write_file(const std::filesystem::path& path, std::string_view bytes);

// Appends and syncs; for logs of finished work that a later run resumes from.
void append_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace engine
