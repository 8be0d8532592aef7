#include "nn/executor.h"

#include <algorithm>
#include <array>

namespace nn {

namespace {

constexpr std::array<std::string_view, 4> precision_names = {"fp32", "bf16", "int8", "int16"};

}  // namespace

std::string_view name_of(Precision precision) {
    return precision_names[static_cast<std::size_t>(precision)];
}

std::optional<Precision> precision_from(std::string_view name) {
    const auto found = std::find(precision_names.begin(), precision_names.end(), name);
    if (found == precision_names.end()) return {};
    return static_cast<Precision>(found - precision_names.begin());
}

}  // namespace nn
