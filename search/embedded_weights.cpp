#include "search/embedded_weights.h"

#include <algorithm>
#include <array>
#include <cstddef>

// From weights/embed.S.in.
extern "C" {
extern const char sanban_weights_go[], sanban_weights_go_end[];
extern const char sanban_weights_chess[], sanban_weights_chess_end[];
extern const char sanban_weights_shogi[], sanban_weights_shogi_end[];
}

namespace search {

std::string_view embedded_weights(std::string_view game) {
    struct File {
        std::string_view game;
        const char *begin, *end;
    };
    static constexpr std::array files{
        File{"go", sanban_weights_go, sanban_weights_go_end},
        File{"chess", sanban_weights_chess, sanban_weights_chess_end},
        File{"shogi", sanban_weights_shogi, sanban_weights_shogi_end}};
    const auto* const found = std::find_if(files.begin(), files.end(),
                                           [&](const File& file) { return file.game == game; });
    if (found == files.end()) return {};
    return {found->begin, static_cast<std::size_t>(found->end - found->begin)};
}

}  // namespace search
