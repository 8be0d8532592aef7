// The stages of AlphaGo's training in one folder as one page of HTML that refers to nothing outside
// itself: what each has learned over its time, from the journals that they keep.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "engine/base/option.h"

namespace selfplay::alphago {

// What is not there yet, or not legible, is left out.
std::string report_html(const std::filesystem::path& folder, const std::string& title,
                        std::span<const engine::OptionRow> settings);

}  // namespace selfplay::alphago
