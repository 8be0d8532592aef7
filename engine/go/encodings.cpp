// The one list of how networks see Go.
#include <array>

#include "engine/go/go.h"
#include "engine/go/history_planes.h"
#include "engine/go/katago_v7.h"

namespace go {

std::span<const engine::Encoding<Go>> Go::encodings() {
    static const std::array rows = {alphazero(), katago_v7(), leela_zero(), leela_zero_black()};
    return rows;
}

}  // namespace go
