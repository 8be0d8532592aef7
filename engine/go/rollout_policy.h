// How the search's rollouts choose their moves: they save chains from atari, capture, answer the
// last moves by 3x3 patterns (Gelly et al. 2006), and else play anywhere, own eyes and hopeless
// self-ataris aside. One a rollout. For rollouts.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>

#include "engine/base/random.h"
#include "engine/go/patterns.h"
#include "engine/go/rollout_board.h"
#include "engine/go/rollout_tactics.h"

namespace go {

template <int most_size>
class RolloutPolicy {
   public:
    using Board = RolloutBoard<most_size, true>;

    explicit RolloutPolicy(const Go& from)
        : board_(from), last_(played(from, 0)), previous_(played(from, 1)) {}

    // Plays a move or, with none left worth it, passes; 0 for a pass, else the index.
    template <Colour colour>
    int play(engine::Random& random);

    const Board& board() const { return board_; }

    // How good a move of `mover`, legal and to `point` or a pass, looks before any reading: the
    // product of its features' strengths, as in Coulom 2007 ("Computing Elo ratings of move
    // patterns"), 1 for a move without any.
    float weight(std::optional<Point> point, Colour mover) const;

   private:
    static int played(const Go& game, int ago) {
        const auto move = game.move_before(ago);
        if (!move || *move == Go::pass) return 0;
        return Board::index(*game.point_of(*move));
    }

    template <Colour colour>
    void answer_atari();
    template <Colour colour>
    void save(int stone);
    template <Colour colour>
    void fit_patterns(int around);
    template <Colour colour>
    int liberties_after(int at) const {
        return go::liberties_after<colour>(board_, at);
    }
    template <Colour colour>
    bool is_blunder(int at, engine::Random& random) const;
    template <Colour colour>
    float weight(int at) const;
    template <Colour colour>
    float contact_weight(int at) const;
    template <Colour colour>
    bool frees_from_atari(int captured) const;
    float position_weight(int at) const;
    bool is_deserted(int at) const;

    void propose(int at) { moves_[static_cast<std::size_t>(count_++)] = at; }
    template <Colour colour>
    int play_proposed(engine::Random& random);

    static constexpr int most_proposed = 32;

    const Patterns& patterns_ = Patterns::all();
    Board board_;
    int last_, previous_;
    std::array<int, most_proposed> moves_;
    int count_ = 0;
};

template <int most_size>
template <Colour colour>
int RolloutPolicy<most_size>::play(engine::Random& random) {
    int played = 0;
    count_ = 0;
    if (last_ != 0) {
        answer_atari<colour>();
        played = play_proposed<colour>(random);
        if (played == 0) {
            fit_patterns<colour>(last_);
            if (previous_ != 0) fit_patterns<colour>(previous_);
            played = play_proposed<colour>(random);
        }
    }
    if (played == 0)
        played = board_.template play_random<colour>(
            random, [&](int at) { return !is_blunder<colour>(at, random); });
    previous_ = last_;
    last_ = played;
    return played;
}

// One of the moves proposed, played, and none proposed any more; 0 without any.
template <int most_size>
template <Colour colour>
int RolloutPolicy<most_size>::play_proposed(engine::Random& random) {
    if (count_ == 0) return 0;
    const int at = moves_[static_cast<std::size_t>(random.below(count_))];
    count_ = 0;
    board_.template play<colour>(at);
    return at;
}

template <int most_size>
template <Colour colour>
void RolloutPolicy<most_size>::answer_atari() {
    if (board_.at(last_) == opponent(colour) && board_.in_atari(last_)) {
        const int at = board_.last_liberty(last_);
        if (board_.template is_legal<colour>(at)) propose(at);
    }
    int saved = 0;
    for (const int beside : Board::neighbours(last_)) {
        if (board_.at(beside) != colour || !board_.in_atari(beside)) continue;
        if (board_.head(beside) == saved) continue;
        saved = board_.head(beside);
        save<colour>(beside);
    }
}

template <int most_size>
template <Colour colour>
void RolloutPolicy<most_size>::save(int chain) {
    for_each_rescue<colour>(board_, chain, [&](int at, bool) {
        if (count_ < most_proposed) propose(at);
    });
}

template <int most_size>
template <Colour colour>
void RolloutPolicy<most_size>::fit_patterns(int around) {
    for (const int at : Board::around(around))
        if (board_.at(at) == Colour::empty &&
            patterns_.template fit<colour>(board_.surroundings(at)) &&
            liberties_after<colour>(at) > 1)
            propose(at);
}

template <int most_size>
template <Colour colour>
bool RolloutPolicy<most_size>::is_blunder(int at, engine::Random& random) const {
    if (liberties_after<colour>(at) > 1) return false;
    int joined = 1;
    for (const int beside : Board::neighbours(at)) {
        if (board_.at(beside) == opponent(colour) && board_.in_atari(beside)) return false;
        if (board_.at(beside) == colour) joined += board_.chain_size(beside);
    }
    return joined > 4 || random.below(2) == 0;
}

template <int most_size>
float RolloutPolicy<most_size>::weight(std::optional<Point> point, Colour mover) const {
    constexpr float pass = 0.05f;
    if (!point) return pass;
    const int at = Board::index(*point);
    return mover == Colour::black ? weight<Colour::black>(at) : weight<Colour::white>(at);
}

template <int most_size>
template <Colour colour>
float RolloutPolicy<most_size>::weight(int at) const {
    constexpr float pattern = 3, self_atari = 0.06f, own_eye = 0.01f;
    if (board_.template is_eye<colour>(at)) return own_eye;
    const float contact = contact_weight<colour>(at);
    float product = contact * position_weight(at);
    if (patterns_.template fit<colour>(board_.surroundings(at))) product *= pattern;
    if (contact <= 1 && liberties_after<colour>(at) < 2) product *= self_atari;
    return product;
}

// What the move does to the chains beside it: the best of it.
template <int most_size>
template <Colour colour>
float RolloutPolicy<most_size>::contact_weight(int at) const {
    constexpr float capture = 10, great_capture = 20, rescue = 30, extension = 11, atari = 1.6f;
    float best = 1;
    for (const int beside : Board::neighbours(at)) {
        const auto there = board_.at(beside);
        if (there != Colour::black && there != Colour::white) continue;
        if (there == colour) {
            if (board_.in_atari(beside) && liberties_after<colour>(at) > 1)
                best = std::max(best, extension);
            continue;
        }
        auto left = board_.liberties(beside);
        for (const int side : Board::neighbours(at))
            if (board_.head(side) == board_.head(beside)) left -= LibertySum(at);
        if (left.none())
            best = std::max(best, frees_from_atari<colour>(beside) ? rescue
                                  : board_.chain_size(beside) > 1  ? great_capture
                                                                   : capture);
        else if (left.only_one() && liberties_after<colour>(at) > 1)
            best = std::max(best, atari);
    }
    return best;
}

// Whether a chain of the mover's in atari touches the one taken.
template <int most_size>
template <Colour colour>
bool RolloutPolicy<most_size>::frees_from_atari(int captured) const {
    int stone = captured;
    do {
        for (const int beside : Board::neighbours(stone))
            if (board_.at(beside) == colour && board_.in_atari(beside)) return true;
        stone = board_.next(stone);
    } while (stone != captured);
    return false;
}

// What distances from the last two moves and the edge make of it.
template <int most_size>
float RolloutPolicy<most_size>::position_weight(int at) const {
    constexpr float near_last[] = {1, 1, 4.3f, 2.8f, 2.2f, 1.6f},
                    near_previous[] = {1, 1, 3, 2.4f, 1.9f, 1.3f};
    constexpr float first_line = 0.25f, second_line = 0.7f, third_line = 1.3f;
    const auto here = Board::point_of(at);
    const auto distance = [&](int other) {
        const auto there = Board::point_of(other);
        const int dx = std::abs(here.x - there.x), dy = std::abs(here.y - there.y);
        return static_cast<std::size_t>(std::min(dx + dy + std::max(dx, dy), 6));
    };
    float product = 1;
    if (last_ != 0 && distance(last_) < 6) product *= near_last[distance(last_)];
    if (previous_ != 0 && distance(previous_) < 6) product *= near_previous[distance(previous_)];
    const int last_line = board_.size() - 1;
    const int line = std::min({here.x, here.y, last_line - here.x, last_line - here.y});
    if (!is_deserted(at)) return product;
    return product * (line == 0   ? first_line
                      : line == 1 ? second_line
                      : line == 2 ? third_line
                                  : 1.0f);
}

// No stone around.
template <int most_size>
bool RolloutPolicy<most_size>::is_deserted(int at) const {
    for (const int beside : Board::around(at))
        if (board_.at(beside) == Colour::black || board_.at(beside) == Colour::white) return false;
    return true;
}

}  // namespace go
