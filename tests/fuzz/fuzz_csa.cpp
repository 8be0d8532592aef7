// Any bytes as CSA: games whose text gives the same moves again, or an engine::Error.
#include <cassert>
#include <cstdint>
#include <string_view>

#include "engine/base/error.h"
#include "engine/shogi/csa.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        for (const auto& record : shogi::csa::parse(text)) {
            const auto again = shogi::csa::parse(shogi::csa::to_text(record));
            assert(again.size() == 1 && again[0].main_line() == record.main_line());
        }
    } catch (const engine::Error&) {
        return 0;
    }
    return 0;
}
