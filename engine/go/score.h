// Who owns what at the end of a game of Go, and the result. SPEC's "Scoring in Go".
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/go/go.h"
#include "engine/go/point_rows.h"

namespace go {

// Chains that cannot be captured even if their owner always passes (Benson 1976), with the
// regions they own: per point (y * size + x) the colour, else empty.
std::vector<std::optional<Player>> pass_alive(const Go& game);

// The points that each player owns, Black's first, on the board as it stands.
using Owners = std::array<PointRows, 2>;
Owners area_owners(const Go& game);

struct Score {
    std::vector<std::optional<Player>> owners;  // per point (y * size + x); nobody's is empty
    int lead_halves = 0;  // Black's lead in half points, komi and bonus counted

    Outcome outcome() const;
    std::string text() const;  // "B+3.5", "W+0.5", "0"
};

// The board as it stands under the game's rules, after `dead` stones (points) are taken off.
Score score(const Go& game, std::span<const Point> dead = {});

enum class Status : std::uint8_t { alive, seki, dead };

}  // namespace go
