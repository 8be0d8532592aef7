// Any bytes as KIF or KI2: a game whose text gives the same moves again, or an engine::Error.
#include <cassert>
#include <cstdint>
#include <string_view>

#include "engine/base/error.h"
#include "engine/shogi/kif.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        const auto record = shogi::kif::parse(text);
        const auto again = shogi::kif::parse(shogi::kif::to_text(record));
        assert(again.main_line() == record.main_line());
        assert(again.nodes.size() == record.nodes.size());
    } catch (const engine::Error&) {
        return 0;
    }
    return 0;
}
