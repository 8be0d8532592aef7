#include "engine/chess/encoding.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdlib>

#include "engine/chess/attacks_encoding.h"
#include "engine/chess/lc0_112.h"
#include "engine/chess/plane_writer.h"
#include "engine/encoding.h"

namespace chess {

namespace alphazero {

namespace {

using Step = std::array<int, 2>;  // files to the right, ranks up

constexpr std::array<Step, 8> directions = {
    {{0, 1}, {1, 1}, {1, 0}, {1, -1}, {0, -1}, {-1, -1}, {-1, 0}, {-1, 1}}};
constexpr std::array<Step, 8> leaps = {
    {{1, 2}, {2, 1}, {2, -1}, {1, -2}, {-1, -2}, {-2, -1}, {-2, 1}, {-1, 2}}};
constexpr int first_leap = 56, first_underpromotion = 64;

int number_of(const std::array<Step, 8>& steps, const Step& step) {
    return static_cast<int>(std::find(steps.begin(), steps.end(), step) - steps.begin());
}

constexpr int sign(int number) { return (number > 0) - (number < 0); }

int move_plane(const Step& step, Move move) {
    if (kind_of(move) == MoveKind::promotion && promoted_of(move) != Piece::queen)
        return first_underpromotion + 3 * (static_cast<int>(promoted_of(move)) - 1) + step[0] + 1;
    const int leap = number_of(leaps, step);
    if (leap < 8) return first_leap + leap;
    const int distance = std::max(std::abs(step[0]), std::abs(step[1]));
    return number_of(directions, {sign(step[0]), sign(step[1])}) * 7 + distance - 1;
}

void write_board(const Chess::PastBoard& past, PlaneWriter& writer) {
    writer.men(past.board);
    writer.full(past.repetitions >= 1 ? 1.0f : 0.0f);
    writer.full(past.repetitions >= 2 ? 1.0f : 0.0f);
}

engine::EncodingShape shape(const Chess&) {
    return {.planes = planes, .height = 8, .width = 8, .globals = 0, .policy_size = policy_size};
}

}  // namespace

void write(const Chess& game, std::span<float> out, std::span<float> globals) {
    assert(out.size() == std::size_t{planes} * 64 && globals.empty());
    static_cast<void>(globals);
    const Position& position = game.position();
    const Player mover = game.to_play();
    PlaneWriter writer(out, mover);
    for (int ago = 0; ago < boards; ++ago) {
        const auto past = game.board_before(ago);
        if (past)
            write_board(*past, writer);
        else
            writer.skip(planes_per_board);
    }
    writer.full(mover == Player::second ? 1.0f : 0.0f);
    const int move_number = position.ply() / 2 + 1;
    writer.full(static_cast<float>(move_number) / 100);
    writer.castling(position);
    writer.full(static_cast<float>(position.halfmove_clock()) / 100);
}

int policy_index(const Chess& game, Move move) {
    const Square from = seen_by(game.to_play(), from_of(move));
    const Square to = seen_by(game.to_play(), to_of(move));
    const Step step = {file_of(to) - file_of(from), rank_of(to) - rank_of(from)};
    return move_plane(step, move) * 64 + from;
}

}  // namespace alphazero

namespace {

std::uint64_t network_key(const Chess& game) {
    const auto& position = game.position();
    std::uint64_t key = engine::mixed(game.key(), static_cast<std::uint64_t>(position.ply()));
    key = engine::mixed(key, static_cast<std::uint64_t>(position.halfmove_clock()));
    for (int ago = 0; ago < alphazero::boards; ++ago) {
        const auto past = game.board_before(ago);
        if (!past) break;
        key = engine::mixed(key, static_cast<std::uint64_t>(past->repetitions));
        key = past->board.mixed_into(key);
    }
    return key;
}

}  // namespace

std::span<const engine::Encoding<Chess>> Chess::encodings() {
    static const auto list = [] {
        std::array<engine::Encoding<Chess>, 3> rows = {
            {{"alphazero", alphazero::shape, alphazero::write, alphazero::policy_index,
              network_key},
             lc0_112(),
             attacks_encoding()}};
        rows[1].key = network_key;
        return rows;
    }();
    return list;
}

}  // namespace chess
