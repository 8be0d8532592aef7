#include "engine/shogi/encoding.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdlib>

#include "engine/shogi/attacks_encoding.h"
#include "engine/shogi/plane_writer.h"

namespace shogi {
namespace alphazero {
namespace {

constexpr float moves_unit = 512;

void write_board(PlaneWriter& writer, const Position& position, int repetitions) {
    writer.board(position);
    for (int i = 0; i < 3; ++i) writer.constant(repetitions > i ? 1.0f : 0.0f);
    writer.hands(position);
}

constexpr int sign(int x) { return (x > 0) - (x < 0); }

// The plane of a move by so many columns and rows, rows counted downwards.
int movement_plane(int columns, int rows) {
    if (rows == -2 && std::abs(columns) == 1) return columns < 0 ? 64 : 65;
    // Clockwise from straight ahead; by row step and column step.
    constexpr std::array<int, 9> clockwise{7, 0, 1, 6, -1, 2, 5, 4, 3};
    const int step = 4 + 3 * sign(rows) + sign(columns);
    const int direction = clockwise[static_cast<std::size_t>(step)];
    return direction * 8 + std::max(std::abs(columns), std::abs(rows)) - 1;
}

int policy_plane(Move move, Player mover) {
    if (is_drop(move)) return 132 + static_cast<int>(dropped_kind(move)) - 1;
    const auto from = static_cast<int>(cell(from_square(move), mover));
    const auto to = static_cast<int>(cell(to_square(move), mover));
    const int plane = movement_plane(to % 9 - from % 9, to / 9 - from / 9);
    return is_promotion(move) ? plane + 66 : plane;
}

engine::EncodingShape shape(const Shogi&) {
    return {.planes = planes,
            .height = board_size,
            .width = board_size,
            .globals = 0,
            .policy_size = policy_size};
}

}  // namespace

void write(const Shogi& game, std::span<float> out, std::span<float> globals) {
    assert(out.size() == std::size_t{planes} * square_count && globals.empty());
    static_cast<void>(globals);
    const Player mover = game.to_play();
    PlaneWriter writer(out, mover);
    const int known = std::min(boards, game.plies());
    for (int back = 0; back < known; ++back)
        write_board(writer, game.position_before(back), game.repetitions(back));
    writer.skip((boards - known) * planes_per_board);
    writer.constant(mover == Player::second ? 1.0f : 0.0f);
    writer.constant(static_cast<float>(game.move_count()) / moves_unit);
}

int policy_index(const Shogi& game, Move move) {
    const Player mover = game.to_play();
    const int square = is_drop(move) ? to_square(move) : from_square(move);
    return policy_plane(move, mover) * square_count + static_cast<int>(cell(square, mover));
}

}  // namespace alphazero

namespace {

// Past positions by their keys, which hold the hands too.
std::uint64_t network_key(const Shogi& game) {
    std::uint64_t key = engine::mixed(game.key(), static_cast<std::uint64_t>(game.move_count()));
    for (int back = 0; back < std::min(alphazero::boards, game.plies()); ++back) {
        key = engine::mixed(key, game.key_before(back));
        key = engine::mixed(key, static_cast<std::uint64_t>(game.repetitions(back)));
    }
    return key;
}

}  // namespace

std::span<const engine::Encoding<Shogi>> Shogi::encodings() {
    static const std::array<engine::Encoding<Shogi>, 2> list = {
        {{"alphazero", alphazero::shape, alphazero::write, alphazero::policy_index, network_key},
         attacks_encoding()}};
    return list;
}

}  // namespace shogi
