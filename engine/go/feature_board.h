// A tactical rollout board that knows its last moves and tells the features of moves
// (move_features.h). For the linear policies and for those who train them.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <vector>

#include "engine/go/move_features.h"
#include "engine/go/rollout_board.h"
#include "engine/go/rollout_tactics.h"

namespace go {

template <int most_size>
class FeatureBoard {
   public:
    using Board = RolloutBoard<most_size, true>;

    explicit FeatureBoard(const Go& from)
        : board_(from), last_(played(from, 0)), previous_(played(from, 1)) {
        note_taken(from);
    }

    const Board& board() const { return board_; }

    // A legal move. Returns how many stones it takes: Board::newly_empty.
    template <Colour colour>
    int play(int at) {
        const int taken = board_.template play<colour>(at);
        taken_.clear();
        if (is_shape(taken))
            for (int i = 0; i < taken; ++i) taken_.push_back(board_.newly_empty(i));
        previous_ = last_;
        last_ = at;
        return taken;
    }
    void pass() {
        board_.pass();
        taken_.clear();
        previous_ = last_;
        last_ = 0;
    }

    // The feature of the stones beside an empty point; none where a move of `colour` there is
    // illegal, a ko aside, or fills an own eye.
    template <Colour colour>
    std::optional<int> contact(int at) const;
    // Lines from the edge; none where a stone is around.
    std::optional<int> line(int at) const;

    // Calls visit(at, feature) for what the last moves make of moves, some of them illegal.
    template <Colour colour, class Visit>
    void for_each_answer(Visit visit) const {
        if (last_ == 0) return;
        answer_diamond<colour>(visit);
        answer_atari<colour>(visit);
        answer_capture(visit);
    }

    // Calls visit(feature) for what only the tree policy asks of the move.
    template <Colour colour, class Visit>
    void for_each_tree_feature(int at, Visit visit) const;

   private:
    static constexpr int stride = Board::stride;

    static int played(const Go& game, int ago) {
        const auto move = game.move_before(ago);
        if (!move || *move == Go::pass) return 0;
        return Board::index(*game.point_of(*move));
    }
    static bool is_shape(int stones) { return stones >= 2 && stones <= 8; }

    void note_taken(const Go& from) {
        if (last_ == 0) return;
        const std::size_t mover = from.to_play() == Player::first ? 0 : 1;
        const auto gone = from.stones_before(1)[mover] & ~from.board().stones()[mover];
        if (!is_shape(static_cast<int>(gone.count()))) return;
        for (int y = 0; y < from.size(); ++y)
            for (int x = 0; x < from.size(); ++x)
                if (gone[static_cast<std::size_t>(y * from.size() + x)])
                    taken_.push_back(Board::index({x, y}));
    }

    Colour colour_at(Point point) const {
        const bool on =
            point.x >= 0 && point.y >= 0 && point.x < board_.size() && point.y < board_.size();
        return on ? board_.at(Board::index(point)) : Colour::edge;
    }
    template <Colour colour>
    features::Diamond diamond_around(int at) const;
    template <Colour colour, class Visit>
    void answer_diamond(Visit visit) const;
    template <Colour colour, class Visit>
    void answer_atari(Visit visit) const;
    template <class Visit>
    void answer_capture(Visit visit) const;
    static int distance(int at, int other) {
        const auto here = Board::point_of(at), there = Board::point_of(other);
        const int dx = std::abs(here.x - there.x), dy = std::abs(here.y - there.y);
        return std::clamp(dx + dy + std::max(dx, dy), 2, features::distance_count + 1) - 2;
    }

    Board board_;
    int last_, previous_;
    std::vector<int> taken_;  // by the last move, where they might be a nakade
};

template <int most_size>
template <Colour colour>
std::optional<int> FeatureBoard<most_size>::contact(int at) const {
    const int empty = board_.empty_neighbours(at);
    int captures = 0;
    bool saves = false, joins = false;
    for (const int beside : Board::neighbours(at)) {
        const auto there = board_.at(beside);
        if (there != Colour::black && there != Colour::white) continue;
        const bool in_atari = board_.in_atari(beside);
        if (there == colour) {
            saves = saves || in_atari;
            joins = joins || !in_atari;
        } else if (in_atari) {
            captures = std::max(captures, board_.chain_size(beside) > 1 ? 2 : 1);
        }
    }
    if (empty == 0 && ((captures == 0 && !joins) || board_.template is_eye<colour>(at))) return {};
    return features::contact_feature(captures, saves, std::min(empty, 2));
}

template <int most_size>
std::optional<int> FeatureBoard<most_size>::line(int at) const {
    // Colours 01 and 10 are stones.
    const unsigned seen = board_.surroundings(at);
    if (((seen ^ seen >> 1) & 0x5555) != 0) return {};
    const auto here = Board::point_of(at);
    const int last = board_.size() - 1;
    const int line = std::min({here.x, here.y, last - here.x, last - here.y});
    return features::line + std::min(line, features::line_count - 1);
}

template <int most_size>
template <Colour colour>
features::Diamond FeatureBoard<most_size>::diamond_around(int at) const {
    const auto here = Board::point_of(at);
    features::Diamond diamond;
    for (int i = 0; i < features::diamond_points; ++i) {
        const auto& offset = features::diamond_offsets[static_cast<std::size_t>(i)];
        const auto there = colour_at({here.x + offset.dx, here.y + offset.dy});
        diamond.add(i, there == Colour::empty  ? 0
                       : there == colour       ? 1
                       : there == Colour::edge ? 3
                                               : 2);
    }
    diamond.settle();
    return diamond;
}

template <int most_size>
template <Colour colour, class Visit>
void FeatureBoard<most_size>::answer_diamond(Visit visit) const {
    const auto diamond = diamond_around<colour>(last_);
    const auto last = Board::point_of(last_);
    constexpr int straight = 4, diagonal = 8;  // of the offsets
    for (int i = 0; i < features::diamond_points; ++i) {
        const auto& offset = features::diamond_offsets[static_cast<std::size_t>(i)];
        const Point point{last.x + offset.dx, last.y + offset.dy};
        if (colour_at(point) != Colour::empty) continue;
        const int at = Board::index(point);
        visit(at, diamond.response_feature(i));
        if (i < diagonal) visit(at, features::beside_last + (i < straight ? 0 : 1));
    }
}

template <int most_size>
template <Colour colour, class Visit>
void FeatureBoard<most_size>::answer_atari(Visit visit) const {
    std::array<int, 4> saved{};
    std::size_t count = 0;
    for (const int beside : Board::neighbours(last_)) {
        if (board_.at(beside) != colour || !board_.in_atari(beside)) continue;
        const int head = board_.head(beside);
        if (std::find(saved.begin(), saved.begin() + count, head) != saved.begin() + count)
            continue;
        saved[count++] = head;
        for_each_rescue<colour>(board_, beside, [&](int at, bool captures) {
            visit(at, features::save + (captures ? 1 : 0));
        });
    }
}

template <int most_size>
template <class Visit>
void FeatureBoard<most_size>::answer_capture(Visit visit) const {
    for (const int at : taken_) {
        const auto here = Board::point_of(at);
        std::vector<features::Offset> shape;
        for (const int other : taken_) {
            const auto there = Board::point_of(other);
            shape.push_back({there.x - here.x, there.y - here.y});
        }
        visit(at, features::nakade_feature(shape));
    }
}

template <int most_size>
template <Colour colour, class Visit>
void FeatureBoard<most_size>::for_each_tree_feature(int at, Visit visit) const {
    if (liberties_after<colour>(board_, at) == 1) visit(features::self_atari);
    if (last_ != 0) visit(features::last_distance + distance(at, last_));
    if (previous_ != 0) visit(features::previous_distance + distance(at, previous_));
    visit(diamond_around<colour>(at).feature());
}

}  // namespace go
