// The kinds of shogi pieces and the one-byte code of a piece on the board.
#pragma once

#include <array>
#include <cstdint>

#include "engine/game.h"

namespace shogi {

using engine::Player;

constexpr std::size_t index(Player player) { return static_cast<std::size_t>(player); }

// A promoted kind is its own kind + 8; gold and king do not promote.
enum class Kind : std::uint8_t {
    none,
    pawn,
    lance,
    knight,
    silver,
    gold,
    bishop,
    rook,
    king,
    tokin,
    promoted_lance,
    promoted_knight,
    promoted_silver,
    horse = 14,
    dragon,
};
inline constexpr int kind_count = 16;

// Those that can be in hand, the least valuable first.
inline constexpr std::array hand_kinds{Kind::pawn, Kind::lance,  Kind::knight, Kind::silver,
                                       Kind::gold, Kind::bishop, Kind::rook};
inline constexpr std::array board_kinds{Kind::pawn,
                                        Kind::lance,
                                        Kind::knight,
                                        Kind::silver,
                                        Kind::gold,
                                        Kind::bishop,
                                        Kind::rook,
                                        Kind::king,
                                        Kind::tokin,
                                        Kind::promoted_lance,
                                        Kind::promoted_knight,
                                        Kind::promoted_silver,
                                        Kind::horse,
                                        Kind::dragon};

constexpr std::size_t index(Kind kind) { return static_cast<std::size_t>(kind); }
constexpr bool is_promoted(Kind kind) { return kind > Kind::king; }
constexpr bool can_promote(Kind kind) {
    return kind < Kind::king && kind != Kind::gold && kind != Kind::none;
}
constexpr Kind promoted(Kind kind) { return static_cast<Kind>(index(kind) | 8); }
// What a captured piece becomes in hand; a king stays a king.
constexpr Kind unpromoted(Kind kind) {
    return is_promoted(kind) ? static_cast<Kind>(index(kind) & 7) : kind;
}

// How many of a kind a full set has, both players together.
inline constexpr std::array<int, 9> full_set{0, 18, 4, 4, 4, 4, 2, 2, 2};

// A piece of one player, or nothing.
class Piece {
   public:
    constexpr Piece() = default;
    constexpr Piece(Player player, Kind kind)
        : code_(static_cast<std::uint8_t>(index(kind) | index(player) << 4)) {}
    constexpr bool empty() const { return code_ == 0; }
    constexpr Kind kind() const { return static_cast<Kind>(code_ & 15); }
    constexpr Player player() const { return static_cast<Player>(code_ >> 4); }
    // Below 32.
    constexpr std::size_t code() const { return code_; }
    constexpr bool operator==(const Piece&) const = default;

   private:
    std::uint8_t code_ = 0;
};

}  // namespace shogi
