// The one list of how networks see Go.
#include <array>
#include <functional>

#include "engine/go/alphago_planes.h"
#include "engine/go/go.h"
#include "engine/go/history_planes.h"
#include "engine/go/katago_v7.h"

namespace go {

namespace {

// Points that superko forbids follow from the legal moves.
std::uint64_t key(const Go& game) {
    const auto& rules = game.rules();
    std::uint64_t key = game.key();
    for (const int number :
         {static_cast<int>(rules.ko), static_cast<int>(rules.scoring), static_cast<int>(rules.tax),
          static_cast<int>(rules.suicide), game.komi().halves(), game.white_bonus(), game.size(),
          game.consecutive_passes(), game.stone_surplus()})
        key = engine::mixed(key, static_cast<std::uint64_t>(number));
    for (int ago = 0; ago < Go::remembered; ++ago) {
        const auto move = game.move_before(ago);
        key = engine::mixed(key, move ? move->code : 0xffff);
        for (const auto& stones : game.stones_before(ago))
            key = engine::mixed(key, std::hash<PointSet>()(stones));
    }
    return key;
}

template <std::size_t count>
std::array<engine::Encoding<Go>, count> keyed(std::array<engine::Encoding<Go>, count> rows) {
    for (auto& row : rows) row.key = key;
    return rows;
}

}  // namespace

std::span<const engine::Encoding<Go>> Go::encodings() {
    static const auto rows =
        keyed(std::array{alphazero(), katago_v7(), leela_zero(), leela_zero_black(),
                         alphago_policy(), alphago_value()});
    return rows;
}

}  // namespace go
