// Any bytes are USI over shogi.
#include "engine/shogi/rollouts.h"
#include "engine/shogi/shogi.h"
#include "tests/fuzz/uci_lines.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzz::check_lines<shogi::Shogi>(protocols::usi_dialect, data, size);
}
