// Compressed bytes to plain ones, for foreign network files.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace nn {

bool is_gzip(std::string_view bytes);

// Fails with engine::Error on damaged or cut input, and as soon as the result would be larger than
// any honest weight file of this size.
std::string gunzip(std::string_view bytes);

}  // namespace nn
