// Any bytes as a network file: a network or an engine::Error, never a crash.
#include <cstdint>
#include <string_view>

#include "engine/base/error.h"
#include "nn/leela_zero.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        nn::graph_from_leela_zero({reinterpret_cast<const char*>(data), size});
    } catch (const engine::Error&) {
        return 0;
    }
    return 0;
}
