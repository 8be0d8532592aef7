// Any bytes are read as SGF or refused; what is read is written and read back the same, and its
// main line replays or is refused.
#include <cstdint>
#include <cstdlib>

#include "engine/base/error.h"
#include "engine/go/sgf.h"

namespace {

void check_round_trip(const go::sgf::Tree& tree) {
    const auto text = go::sgf::to_text(tree);
    const auto again = go::sgf::parse(text);
    if (again.size() != 1 || go::sgf::to_text(again.front()) != text) std::abort();
}

void check_main_line(const go::sgf::Tree& tree) {
    try {
        const auto record = go::sgf::main_line(tree);
        const auto written = go::sgf::tree_of(record.start, record.turns, record.result);
        if (go::sgf::main_line(written).turns != record.turns) std::abort();
    } catch (const engine::Error&) {
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    go::sgf::GameReader reader({reinterpret_cast<const char*>(data), size});
    for (bool more = true; more;) {
        try {
            const auto tree = reader.next();
            more = tree.has_value();
            if (!tree) continue;
            check_round_trip(*tree);
            check_main_line(*tree);
        } catch (const engine::Error&) {
        }
    }
    return 0;
}
