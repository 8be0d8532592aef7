// The networks that this executable carries, as the build found them (weights/README.md). Constant
// data, for any thread.
#pragma once

#include <array>
#include <string_view>

namespace search {

// The name under which load_player finds the one that suits game and board.
inline constexpr std::string_view embedded_name = "default";

// The networks for Go on large boards, the largest first; "go" plays the smaller ones.
struct EmbeddedGo {
    int least_size;
    std::string_view name;
};
inline constexpr std::array<EmbeddedGo, 2> embedded_large_go = {
    {{16, "go-19x19"}, {10, "go-13x13"}}};

// AlphaGo's networks for boards of 19x19: a folder of the weights.
inline constexpr std::string_view embedded_alphago = "alphago-19x19";

// The weight file of that name in the folder of weights, without its extension: "go", or
// "alphago-19x19/policy". Empty where there is none.
std::string_view embedded_weights(std::string_view name);

}  // namespace search
