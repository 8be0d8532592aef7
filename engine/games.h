// The games this program plays. To add one: write its folder, then name its type below.
#pragma once

#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include "engine/base/error.h"
#include "engine/chess/chess.h"
#include "engine/chess/exchanges.h"
#include "engine/chess/rollouts.h"
#include "engine/game.h"
#include "engine/go/go.h"
#include "engine/go/rollouts.h"
#include "engine/shogi/exchanges.h"
#include "engine/shogi/rollouts.h"
#include "engine/shogi/shogi.h"

namespace engine {

template <Game... Gs>
struct GameList {
    // Calls action.template operator()<G>() for the game so named: the one place where a
    // name read at run time becomes a type. Fails on an unknown name.
    template <class Action>
    static auto visit(std::string_view name, Action action) {
        using Result = std::common_type_t<decltype(action.template operator()<Gs>())...>;
        std::optional<Result> result;
        const bool known =
            ((Gs::name == name && (result = action.template operator()<Gs>(), true)) || ...);
        if (!known) fail("unknown game: {}", name);
        return *std::move(result);
    }
};

using Games = GameList<go::Go, chess::Chess, shogi::Shogi>;

}  // namespace engine
