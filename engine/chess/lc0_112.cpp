#include "engine/chess/lc0_112.h"

#include <algorithm>
#include <cstdlib>

#include "engine/chess/plane_writer.h"

namespace chess {

namespace {

constexpr int boards = 8, planes_per_board = 13, plane_count = 112, policy_size = 1858;
constexpr int castling_planes = boards * planes_per_board, ones_plane = 111;

engine::EncodingShape shape(const Chess&) { return {plane_count, 8, 8, 0, policy_size, 1}; }

class Writer {
   public:
    Writer(const Chess& game, std::span<float> planes)
        : game_(game), planes_(planes), mover_(game.to_play()) {
        std::fill(planes.begin(), planes.end(), 0.0f);
    }

    void write() {
        int ago = 0;
        std::optional<Chess::PastBoard> oldest;
        for (; ago < boards; ++ago) {
            const auto past = game_.board_before(ago);
            if (!past) break;
            oldest = past;
            write_board(ago, *past, false);
        }
        const bool from_start = oldest->board == PackedBoard(Position());
        for (; ago < boards && !from_start; ++ago) write_board(ago, *oldest, true);
        write_rest();
    }

   private:
    float& at(int plane, Square square) {
        return planes_[static_cast<std::size_t>(plane) * 64 + index(seen_by(mover_, square))];
    }
    void set(int plane, Square square) { at(plane, square) = 1; }
    void clear(int plane, Square square) { at(plane, square) = 0; }
    void fill(int plane, float value) {
        std::fill_n(planes_.begin() + std::ptrdiff_t{plane} * 64, 64, value);
    }

    void write_board(int slot, const Chess::PastBoard& past, bool made_up) {
        int plane = slot * planes_per_board;
        for (const Player player : {mover_, ~mover_})
            for (int piece = 0; piece < piece_kinds; ++piece, ++plane) {
                Bitboard squares = past.board.pieces(player, static_cast<Piece>(piece));
                while (squares != 0) set(plane, pop(squares));
            }
        if (past.repetitions > 0) fill(plane, 1);
        if (made_up) take_back_double_step(slot);
    }

    // A pawn that may be captured in passing stood on its first square one ply before the position
    // that the game began with.
    void take_back_double_step(int slot) {
        const auto passed = game_.position().en_passant();
        if (!passed || game_.board_before(1)) return;
        const int up = mover_ == Player::first ? 8 : -8;
        const int enemy_pawns = slot * planes_per_board + piece_kinds;
        clear(enemy_pawns, *passed - up);
        set(enemy_pawns, *passed + up);
    }

    void write_rest() {
        const auto& position = game_.position();
        int plane = castling_planes;
        for (const Player player : {mover_, ~mover_})
            for (const bool king_side : {false, true})
                fill(plane++, position.castling_rook(player, king_side) ? 1.0f : 0.0f);
        fill(plane++, mover_ == Player::second ? 1.0f : 0.0f);
        fill(plane, static_cast<float>(position.halfmove_clock()));
        fill(ones_plane, 1);
    }

    const Chess& game_;
    std::span<float> planes_;
    Player mover_;
};

void write(const Chess& game, std::span<float> planes, std::span<float>) {
    Writer(game, planes).write();
}

// Where lc0's list has each move by (from, to); then promotions to queen, rook, bishop.
class MoveTable {
   public:
    MoveTable() {
        std::uint16_t next = 0;
        for (Square from = 0; from < 64; ++from)
            for (Square to = 0; to < 64; ++to) {
                const int dx = std::abs(to % 8 - from % 8), dy = std::abs(to / 8 - from / 8);
                const bool reachable = dx == 0 || dy == 0 || dx == dy || dx * dy == 2;
                if (from != to && reachable) plain_[entry(from, to)] = next++;
            }
        for (Square file = 0; file < 8; ++file)
            for (Square to = std::max(file - 1, 0); to <= std::min(file + 1, 7); ++to, next += 3)
                promotions_[index(file) * 8 + index(to)] = next;
    }
    int plain(Square from, Square to) const { return plain_[entry(from, to)]; }
    int promotion(Square from, Square to) const {
        return promotions_[index(from % 8) * 8 + index(to % 8)];
    }

   private:
    static std::size_t entry(Square from, Square to) { return index(from) * 64 + index(to); }
    std::array<std::uint16_t, 4096> plain_{};
    std::array<std::uint16_t, 64> promotions_{};
};

int policy_index(const Chess& game, Move move) {
    static const MoveTable table;
    const Square from = seen_by(game.to_play(), from_of(move));
    const Square to = seen_by(game.to_play(), to_of(move));
    if (kind_of(move) != MoveKind::promotion || promoted_of(move) == Piece::knight)
        return table.plain(from, to);
    return table.promotion(from, to) + static_cast<int>(Piece::queen) -
           static_cast<int>(promoted_of(move));
}

}  // namespace

engine::Encoding<Chess> lc0_112() { return {"lc0-112", shape, write, policy_index, nullptr}; }

}  // namespace chess
