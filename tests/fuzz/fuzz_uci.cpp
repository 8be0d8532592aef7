// Any bytes are UCI over chess.
#include "engine/chess/chess.h"
#include "engine/chess/rollouts.h"
#include "tests/fuzz/uci_lines.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzz::check_lines<chess::Chess>(protocols::uci_dialect, data, size);
}
