#include "engine/go/history_planes.h"

#include <algorithm>

namespace go {

namespace {

constexpr int stone_planes = 2 * Go::remembered;

// The mover's stones now and 7 moves back, then the opponent's.
void write_stones(const Go& game, std::span<float> planes) {
    const auto size = static_cast<std::size_t>(game.size());
    const auto points = size * size;
    const std::size_t mover = game.to_play() == Player::first ? 0 : 1;
    std::size_t plane = 0;
    for (const auto player : {mover, 1 - mover})
        for (int ago = 0; ago < Go::remembered; ++ago, ++plane) {
            const auto& stones = game.stones_before(ago)[player];
            for (std::size_t p = 0; p < points; ++p)
                planes[plane * points + p] = stones[p] ? 1.0f : 0.0f;
        }
}

void fill_plane(const Go& game, std::span<float> planes, int plane, bool one) {
    const auto points = game.size() * game.size();
    std::fill_n(planes.begin() + std::ptrdiff_t{plane} * points, points, one ? 1.0f : 0.0f);
}

void write_alphazero(const Go& game, std::span<float> planes, std::span<float>) {
    write_stones(game, planes);
    fill_plane(game, planes, stone_planes, game.to_play() == Player::first);
}

void write_leela_zero(const Go& game, std::span<float> planes, std::span<float>) {
    write_stones(game, planes);
    fill_plane(game, planes, stone_planes, game.to_play() == Player::first);
    fill_plane(game, planes, stone_planes + 1, game.to_play() == Player::second);
}

}  // namespace

int point_index(const Go& game, Move move) {
    const int size = game.size();
    const auto point = game.point_of(move);
    return point ? point->y * size + point->x : size * size;
}

engine::Encoding<Go> alphazero() {
    return {"alphazero", point_shape<stone_planes + 1>, write_alphazero, point_index, nullptr};
}

engine::Encoding<Go> leela_zero() {
    return {"leela-zero-18", point_shape<stone_planes + 2>, write_leela_zero, point_index, nullptr};
}

engine::Encoding<Go> leela_zero_black() {
    auto encoding = leela_zero();
    encoding.name = "leela-zero-18-black";
    encoding.value_of_first = true;
    return encoding;
}

}  // namespace go
