// The networks that this executable carries, as the build found them (weights/README.md). Constant
// data, for any thread.
#pragma once

#include <string_view>

namespace search {

// The name under which load_network finds the one of its game.
inline constexpr std::string_view embedded_name = "default";

// The weight file of this game; empty where there is none.
std::string_view embedded_weights(std::string_view game);

}  // namespace search
