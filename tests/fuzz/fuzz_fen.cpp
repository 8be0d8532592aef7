// Any bytes are read as FEN or refused; a position that was read is written and read back the
// same, its moves survive UCI and SAN, and each of them leads to a position that stands the test.
#include <cstdint>
#include <cstdlib>

#include "engine/base/error.h"
#include "engine/chess/epd.h"
#include "engine/chess/san.h"

namespace {

void require(bool condition) {
    if (!condition) std::abort();
}

void check(const chess::Chess& game) {
    require(chess::Chess::from_text(game.to_text()).position() == game.position());
    for (const auto move : game.legal_moves()) {
        require(game.move_from_text(game.move_to_text(move)) == move);
        const auto text = chess::san(game.position(), move);
        require(chess::move_from_san(game.position(), text) == move);
        auto next = game;
        next.play(move);
        if (next.position().ply() < 19000)  // FEN counts to 9999 moves
            require(chess::Chess::from_text(next.to_text()).position() == next.position());
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        check(chess::Chess::from_text(text));
    } catch (const engine::Error&) {
    }
    try {
        chess::problem_from_epd(text);
    } catch (const engine::Error&) {
    }
    return 0;
}
