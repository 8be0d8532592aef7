#include "engine/go/alphago_planes.h"

#include <algorithm>
#include <vector>

#include "engine/go/history_planes.h"
#include "engine/go/ladder.h"

namespace go {

namespace {

class AlphaGoWriter {
   public:
    AlphaGoWriter(const Go& game, std::span<float> planes)
        : game_(game),
          board_(game.board()),
          mover_(colour_of(game.to_play())),
          planes_(planes),
          points_(static_cast<std::size_t>(game.size()) * static_cast<std::size_t>(game.size())) {
        if (const auto ko = game.ko_point()) ko_ = board_.index(ko->x, ko->y);
    }

    void run(bool with_colour) {
        std::fill(planes_.begin(), planes_.end(), 0.0f);
        fill(alphago::ones);
        if (with_colour && game_.to_play() == Player::first) fill(alphago::colour);
        write_ages();
        board_.for_each_point([&](int at) { write_stone(at); });
        board_.for_each_point([&](int at) {
            const Move move{static_cast<std::uint16_t>(at)};
            if (board_.at(at) == Colour::empty && game_.legal(move)) write_move(move);
        });
        write_ladder_captures();
    }

   private:
    void fill(int plane) {
        std::fill_n(planes_.begin() + std::ptrdiff_t{plane} * static_cast<std::ptrdiff_t>(points_),
                    points_, 1.0f);
    }
    void set(int plane, int at) {
        planes_[static_cast<std::size_t>(plane) * points_ + board_.order(at)] = 1;
    }
    // One of the eight planes from `first` on; `number` is 1 or more.
    void set_number(int first, int number, int at) { set(first + std::min(number, 8) - 1, at); }

    void write_ages() {
        constexpr int known = 7;
        std::bitset<most_points> told;
        for (int ago = 0; ago < known; ++ago) {
            const auto move = game_.move_before(ago);
            if (!move) break;
            const int at = move->code;
            if (*move == Go::pass || board_.at(at) == Colour::empty || told[board_.order(at)])
                continue;
            told.set(board_.order(at));
            set_number(alphago::turns_since, ago + 1, at);
        }
        board_.for_each_point([&](int at) {
            if (board_.at(at) != Colour::empty && !told[board_.order(at)])
                set_number(alphago::turns_since, known + 1, at);
        });
    }

    void write_stone(int at) {
        const auto there = board_.at(at);
        set(there == Colour::empty ? alphago::empty
            : there == mover_      ? alphago::own
                                   : alphago::enemy,
            at);
        if (there != Colour::empty && board_.head(at) == at) write_chain(at);
    }

    void write_chain(int head) {
        const int liberties = board_.liberties(head, 8);
        board_.for_each_stone(head, [&](int at) { set_number(alphago::liberties, liberties, at); });
        if (liberties == 1 && board_.at(head) == mover_) in_atari_.push_back(head);
        if (liberties == 2 && board_.at(head) != mover_) in_two_.push_back(head);
    }

    void write_move(Move move) {
        const int at = move.code;
        if (!game_.fills_own_eye(move)) set(alphago::sensible, at);
        int empty = 0, edges = 0;
        for (const int beside : board_.neighbours(at)) {
            empty += board_.at(beside) == Colour::empty;
            edges += board_.at(beside) == Colour::edge;
        }
        if (empty + edges == 4) return write_liberties_after(at, empty, 1);
        LadderBoard next{board_, ko_};
        next.play(at, mover_);
        const int taken = static_cast<int>(stones_of(opponent(mover_), board_)) -
                          static_cast<int>(stones_of(opponent(mover_), next.board));
        if (taken > 0) set_number(alphago::capture_size, taken, at);
        if (next.board.at(at) == Colour::empty) return;  // a suicide that the rules allow
        const int liberties = next.board.liberties(at, 8);
        int size = 0;
        if (liberties == 1) next.board.for_each_stone(at, [&](int) { ++size; });
        write_liberties_after(at, liberties, size);
        if (escapes(next, at, taken > 0)) set(alphago::ladder_escape, at);
    }

    static std::size_t stones_of(Colour colour, const Board& board) {
        return board.stones()[colour == Colour::black ? 0 : 1].count();
    }

    void write_liberties_after(int at, int liberties, int chain) {
        if (liberties == 0) return;
        set_number(alphago::liberties_after, liberties, at);
        if (liberties == 1) set_number(alphago::self_atari_size, chain, at);
    }

    // Whether a chain of the mover's that was in atari gets away, the ladder that may follow read.
    bool escapes(const LadderBoard& next, int at, bool captures) const {
        return std::any_of(in_atari_.begin(), in_atari_.end(), [&](int stone) {
            const bool joined = next.board.head(stone) == next.board.head(at);
            if (!joined && !captures) return false;
            const int liberties = next.board.liberties(stone, 3);
            return liberties > 2 || (liberties == 2 && ladder_captures(next, stone).empty());
        });
    }

    void write_ladder_captures() {
        for (const int stone : in_two_)
            for (const int move : ladder_captures({board_, ko_}, stone))
                if (game_.legal({static_cast<std::uint16_t>(move)}))
                    set(alphago::ladder_capture, move);
    }

    const Go& game_;
    const Board& board_;
    Colour mover_;
    std::span<float> planes_;
    std::size_t points_;
    int ko_ = 0;
    // Heads: of the mover's chains of one liberty, of the opponent's of two.
    std::vector<int> in_atari_, in_two_;
};

template <bool with_colour>
void write(const Go& game, std::span<float> planes, std::span<float>) {
    AlphaGoWriter(game, planes).run(with_colour);
}

}  // namespace

engine::Encoding<Go> alphago_policy() {
    return {"alphago48", point_shape<alphago::policy_planes>, write<false>, point_index, nullptr};
}

engine::Encoding<Go> alphago_value() {
    return {"alphago49", point_shape<alphago::value_planes>, write<true>, point_index, nullptr};
}

}  // namespace go
