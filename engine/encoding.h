// How one network family sees a game: the only tie between games and networks.
//
// A game that has networks lists its encodings in a static member
//     static std::span<const engine::Encoding<G>> encodings();
// whose first row is the one that our own training uses. A network file names its encoding and
// the search asks the game for it by `find_encoding`. The functions of a row keep no state and may
// be called from any thread.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "engine/base/error.h"
#include "engine/game.h"

namespace engine {

// Sizes of one encoded position. They depend on the game only where its board size does.
struct EncodingShape {
    int planes = 0, height = 0, width = 0;
    int globals = 0;  // inputs that have no place on the board
    int policy_size =
        0;  // logits; several moves of the game share one only if a foreign family does
    // 8 where turning and mirroring all planes gives as good a position, the policy being a point's
    // index (row * width + column) and behind them what no symmetry moves; else 1.
    int symmetries = 1;

    constexpr bool operator==(const EncodingShape&) const = default;
    constexpr std::size_t points() const {
        return static_cast<std::size_t>(height) * static_cast<std::size_t>(width);
    }
    constexpr std::size_t planes_size() const {
        return static_cast<std::size_t>(planes) * points();
    }
};

template <class G>
struct Encoding {
    std::string_view name;  // "alphazero", "lc0-112" …
    EncodingShape (*shape)(const G& game);
    // Overwrites `planes` (planes × height × width, row-major) and `globals`, which have exactly
    // the sizes that `shape` says. All is seen by the player to move.
    void (*write)(const G& game, std::span<float> planes, std::span<float> globals);
    // Where the policy holds `move`, legal in `game`: 0 .. policy_size - 1.
    int (*policy_index)(const G& game, Move move);
    // Of all that `write` and `policy_index` look at, the legal moves aside.
    std::uint64_t (*key)(const G& game);
    // Whether the networks of this family tell the first player's value and not the mover's.
    bool value_of_first = false;
};

// Mixes `number` into a key.
constexpr std::uint64_t mixed(std::uint64_t key, std::uint64_t number) {
    key = (key ^ number) * 0x9e3779b97f4a7c15;
    return key ^ key >> 29;
}

template <class G>
concept Encoded = Game<G> && requires {
    { G::encodings() } -> std::convertible_to<std::span<const Encoding<G>>>;
};

// Fails, naming those there are, when the game has no encoding called `name`.
template <Encoded G>
const Encoding<G>& find_encoding(std::string_view name) {
    std::string known;
    for (const auto& encoding : G::encodings()) {
        if (encoding.name == name) return encoding;
        known.append(known.empty() ? "" : ", ").append(encoding.name);
    }
    fail("{} has no encoding \"{}\"; there are: {}", G::name, name, known);
}

}  // namespace engine
