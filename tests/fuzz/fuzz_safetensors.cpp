// Any bytes as a network file: a network or an engine::Error, never a crash.
#include <cstdint>
#include <string_view>

#include "engine/base/error.h"
#include "nn/safetensors.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const std::string_view bytes(reinterpret_cast<const char*>(data), size);
        nn::calibration_from_safetensors(bytes, nn::graph_from_safetensors(bytes));
    } catch (const engine::Error&) {
        return 0;
    }
    return 0;
}
