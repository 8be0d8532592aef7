#include "engine/shogi/attacks_encoding.h"

#include <array>
#include <cassert>

#include "engine/shogi/encoding.h"
#include "engine/shogi/plane_writer.h"

namespace shogi {

namespace {

constexpr int most_counted = 3;
constexpr int planes = 2 * static_cast<int>(board_kinds.size()) + 2 * most_counted +
                       2 * static_cast<int>(hand_kinds.size()) + 2;

// Squares that pieces of `player` attack at least once, twice …
std::array<Bitboard, most_counted> attacks_of(const Position& position, Player player) {
    std::array<Bitboard, most_counted> attacked{};
    for (int square = 0; square < square_count; ++square) {
        const int attackers = count(position.attackers(player, square, position.occupied()));
        for (int i = 0; i < std::min(attackers, most_counted); ++i)
            attacked[static_cast<std::size_t>(i)] |= bit(square);
    }
    return attacked;
}

engine::EncodingShape shape(const Shogi&) {
    return {.planes = planes,
            .height = board_size,
            .width = board_size,
            .globals = 0,
            .policy_size = alphazero::policy_size};
}

void write(const Shogi& game, std::span<float> out, std::span<float> globals) {
    assert(out.size() == std::size_t{planes} * square_count && globals.empty());
    static_cast<void>(globals);
    const Position& position = game.position();
    const Player mover = game.to_play();
    PlaneWriter writer(out, mover);
    writer.board(position);
    for (const Player player : {mover, ~mover})
        for (const Bitboard squares : attacks_of(position, player)) writer.squares(squares);
    writer.hands(position);
    writer.constant(game.repetitions(0) > 0 ? 1.0f : 0.0f);
    writer.constant(1);
}

std::uint64_t key(const Shogi& game) {
    return engine::mixed(game.key(), game.repetitions(0) > 0 ? 1 : 0);
}

}  // namespace

engine::Encoding<Shogi> attacks_encoding() {
    return {"attacks", shape, write, alphazero::policy_index, key};
}

}  // namespace shogi
