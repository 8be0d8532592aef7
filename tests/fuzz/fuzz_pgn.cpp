// Any bytes are read as PGN or refused, game by game; what is read is written, and what was
// written is read back the same.
#include <cstdint>
#include <cstdlib>
#include <sstream>

#include "engine/base/error.h"
#include "engine/chess/pgn.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
    chess::pgn::Reader reader(in);
    for (bool more = true; more;) {
        try {
            const auto record = reader.next();
            more = record.has_value();
            if (!record) continue;
            const auto text = chess::pgn::to_text(*record);
            if (chess::pgn::to_text(chess::pgn::read_one(text)) != text) std::abort();
        } catch (const engine::Error&) {
        }
    }
    return 0;
}
