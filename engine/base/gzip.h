// gzip, for reading: what large collections of records come in.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace engine {

// By its first bytes, not by a name.
bool is_gzip(std::string_view bytes);

// The contents, of several members one after the other too. Fails when they are damaged, cut
// short, or larger than `most` bytes.
std::string gunzip(std::string_view bytes, std::size_t most = std::size_t{1} << 30);

// The whole file, unpacked if it is gzip; at most `most` bytes either way. Fails naming the path.
std::string read_plain_or_gzip(const std::filesystem::path& path,
                               std::size_t most = std::size_t{1} << 30);

}  // namespace engine
