#include "engine/chess/attacks_encoding.h"

#include <array>
#include <cassert>

#include "engine/chess/encoding.h"
#include "engine/chess/plane_writer.h"

namespace chess {

namespace {

constexpr int planes = 4 * piece_kinds + 3 + 4 + 3;

struct Attacks {
    std::array<Bitboard, piece_kinds> by_kind{};
    Bitboard twice = 0;
};

Attacks attacks_of(const Position& position, Player player) {
    Attacks attacks;
    for (Square square = 0; square < 64; ++square) {
        const Bitboard attackers = position.attackers(player, square, position.occupied());
        if (attackers == 0) continue;
        for (int kind = 0; kind < piece_kinds; ++kind)
            if (attackers & position.pieces(static_cast<Piece>(kind)))
                attacks.by_kind[static_cast<std::size_t>(kind)] |= bit(square);
        if (attackers & (attackers - 1)) attacks.twice |= bit(square);
    }
    return attacks;
}

engine::EncodingShape shape(const Chess&) {
    return {.planes = planes,
            .height = 8,
            .width = 8,
            .globals = 0,
            .policy_size = alphazero::policy_size};
}

void write(const Chess& game, std::span<float> out, std::span<float> globals) {
    assert(out.size() == std::size_t{planes} * 64 && globals.empty());
    static_cast<void>(globals);
    const Position& position = game.position();
    const Player mover = game.to_play();
    PlaneWriter writer(out, mover);
    writer.men(position);
    const std::array attacks = {attacks_of(position, mover), attacks_of(position, ~mover)};
    for (const auto& side : attacks)
        for (const Bitboard squares : side.by_kind) writer.set(squares);
    for (const auto& side : attacks) writer.set(side.twice);
    const auto en_passant = position.en_passant();
    writer.set(en_passant ? bit(*en_passant) : 0);
    writer.castling(position);
    writer.full(static_cast<float>(position.halfmove_clock()) / 100);
    writer.full(game.repetitions() > 0 ? 1.0f : 0.0f);
    writer.full(1);
}

std::uint64_t key(const Chess& game) {
    const auto clock = static_cast<std::uint64_t>(game.position().halfmove_clock());
    return engine::mixed(engine::mixed(game.key(), clock), game.repetitions() > 0 ? 1 : 0);
}

}  // namespace

engine::Encoding<Chess> attacks_encoding() {
    return {"attacks", shape, write, alphazero::policy_index, key};
}

}  // namespace chess
