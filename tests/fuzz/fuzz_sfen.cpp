// Any bytes as SFEN: a position that survives its own text and can be played, or an engine::Error.
#include <cassert>
#include <cstdint>
#include <string_view>

#include "engine/base/error.h"
#include "engine/shogi/shogi.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        auto game = shogi::Shogi::from_text(text);
        assert(shogi::Shogi::from_text(game.to_text()).position() == game.position());
        for (int ply = 0; ply < 16 && !game.legal_moves().empty(); ++ply)
            game.play(game.legal_moves()[0]);
    } catch (const engine::Error&) {
        return 0;
    }
    return 0;
}
