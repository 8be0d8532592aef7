// How values stand in SGF text, and which properties the standard knows; for the SGF reader and
// writer only.
#pragma once

#include <string>
#include <string_view>

#include "engine/base/charset.h"

namespace go::sgf {

// Is it one of FF[1] to FF[4]?
bool is_known(std::string_view id);

// Drops escapes and escaped line breaks; every line break becomes "\n". A byte pair of `pairs`
// never reads as an escape.
std::string unescaped(std::string_view raw, engine::Pairs pairs);

// Appends the value with what it needs to be read back the same.
void append_value(std::string& text, std::string_view id, std::string_view value);

}  // namespace go::sgf
