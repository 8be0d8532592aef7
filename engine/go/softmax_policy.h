// AlphaGo's rollout policy at play: a linear softmax over the features of move_features.h, kept up
// to date as stones come and go, so that a move is drawn without looking at the whole board. One a
// rollout.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "engine/base/random.h"
#include "engine/go/feature_board.h"
#include "engine/go/linear_policy.h"

namespace go {

template <int most_size>
class SoftmaxPolicy {
   public:
    using Board = RolloutBoard<most_size, true>;

    // `factors` must outlive it.
    SoftmaxPolicy(const Factors& factors, const Go& from) : factors_(factors), position_(from) {
        for (int y = 0; y < from.size(); ++y)
            for (int x = 0; x < from.size(); ++x) weigh(Board::index({x, y}));
    }

    // Plays a move drawn by the policy or, where it knows none, passes: 0 then, else the index.
    template <Colour colour>
    int play(engine::Random& random);

    const Board& board() const { return position_.board(); }
    // How likely the policy is to play each move, by index; what it never plays is not listed.
    template <Colour colour>
    std::vector<std::pair<int, double>> chances();

   private:
    static constexpr auto cells = static_cast<std::size_t>(Board::cell_count);
    static constexpr auto most_rows = static_cast<std::size_t>(most_size + 1);

    struct Side {
        std::array<std::uint32_t, cells> weights{};
        std::array<std::uint32_t, most_rows> rows{};
        std::uint64_t total = 0;
    };
    // A move whose weight the last moves change.
    struct Answer {
        int at = 0;
        double weight = 0;
    };

    static constexpr std::size_t side_of(Colour colour) { return colour == Colour::black ? 0 : 1; }

    void weigh(int at) {
        weigh<Colour::black>(at);
        weigh<Colour::white>(at);
    }
    template <Colour colour>
    void weigh(int at);
    void weigh_around(int at) {
        weigh(at);
        for (const int beside : Board::around(at))
            if (board().at(beside) != Colour::edge) weigh(beside);
    }
    template <Colour colour>
    void find_answers();
    void answer(int at, std::uint32_t weight, float factor);
    template <Colour colour>
    int draw(engine::Random& random);
    int draw_elsewhere(const Side& side, engine::Random& random) const;
    template <Colour colour>
    void note_freed(int at);
    template <Colour colour>
    void move(int at);

    const Factors& factors_;
    FeatureBoard<most_size> position_;
    std::array<Side, 2> sides_;
    std::array<Answer, 64> answers_;
    std::size_t answer_count_ = 0;
    double answers_total_ = 0;                     // of the answers' weights
    std::uint64_t answers_usual_ = 0;              // what they would weigh otherwise
    std::array<std::uint16_t, cells> answered_{};  // the answer's number, from 1
    std::vector<int> freed_;
};

inline double uniform(engine::Random& random) {
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

template <int most_size>
template <Colour colour>
void SoftmaxPolicy<most_size>::weigh(int at) {
    Side& side = sides_[side_of(colour)];
    std::uint32_t weight = 0;
    if (board().at(at) == Colour::empty)
        if (const auto contact = position_.template contact<colour>(at)) {
            float product =
                factors_.of_pattern(board().surroundings(at), colour) * factors_[*contact];
            if (const auto line = position_.line(at)) product *= factors_[*line];
            weight = Factors::weight(product);
        }
    auto& old = side.weights[static_cast<std::size_t>(at)];
    side.rows[static_cast<std::size_t>(at / Board::stride)] += weight - old;
    side.total += weight;
    side.total -= old;
    old = weight;
}

template <int most_size>
void SoftmaxPolicy<most_size>::answer(int at, std::uint32_t weight, float factor) {
    auto& number = answered_[static_cast<std::size_t>(at)];
    if (number == 0) {
        if (weight == 0 || answer_count_ == answers_.size()) return;
        answers_[answer_count_++] = {at, static_cast<double>(weight)};
        number = static_cast<std::uint16_t>(answer_count_);
        answers_usual_ += weight;
    }
    answers_[number - 1u].weight *= static_cast<double>(factor);
}

template <int most_size>
template <Colour colour>
void SoftmaxPolicy<most_size>::find_answers() {
    const auto& weights = sides_[side_of(colour)].weights;
    for (std::size_t i = 0; i < answer_count_; ++i)
        answered_[static_cast<std::size_t>(answers_[i].at)] = 0;
    answer_count_ = 0;
    answers_usual_ = 0;
    position_.template for_each_answer<colour>([&](int at, int feature) {
        answer(at, weights[static_cast<std::size_t>(at)], factors_[feature]);
    });
    if (const int ko = board().ko()) answer(ko, weights[static_cast<std::size_t>(ko)], 0);
    answers_total_ = 0;
    for (std::size_t i = 0; i < answer_count_; ++i) answers_total_ += answers_[i].weight;
}

template <int most_size>
template <Colour colour>
int SoftmaxPolicy<most_size>::play(engine::Random& random) {
    find_answers<colour>();
    const int at = draw<colour>(random);
    if (at == 0)
        position_.pass();
    else
        move<colour>(at);
    return at;
}

template <int most_size>
template <Colour colour>
int SoftmaxPolicy<most_size>::draw(engine::Random& random) {
    const Side& side = sides_[side_of(colour)];
    const auto elsewhere = static_cast<double>(side.total - answers_usual_);
    double left = uniform(random) * (answers_total_ + elsewhere);
    if (left >= answers_total_) return elsewhere > 0 ? draw_elsewhere(side, random) : 0;
    for (std::size_t i = 0; i < answer_count_; ++i)
        if ((left -= answers_[i].weight) < 0) return answers_[i].at;
    return 0;
}

// Among the points that the last moves do not change.
template <int most_size>
int SoftmaxPolicy<most_size>::draw_elsewhere(const Side& side, engine::Random& random) const {
    while (true) {
        auto left = static_cast<std::uint64_t>(uniform(random) * static_cast<double>(side.total));
        std::size_t row = 1;
        while (left >= side.rows[row]) left -= side.rows[row++];
        auto at = row * static_cast<std::size_t>(Board::stride) + 1;
        while (left >= side.weights[at]) left -= side.weights[at++];
        if (answered_[at] == 0) return static_cast<int>(at);
    }
}

// The last liberties of chains of the mover's that the move, by a capture, takes out of atari.
template <int most_size>
template <Colour colour>
void SoftmaxPolicy<most_size>::note_freed(int at) {
    freed_.clear();
    for (const int beside : Board::neighbours(at)) {
        if (board().at(beside) != opponent(colour) || !board().in_atari(beside)) continue;
        int stone = beside;
        do {
            for (const int other : Board::neighbours(stone))
                if (board().at(other) == colour && board().in_atari(other))
                    freed_.push_back(board().last_liberty(other));
            stone = board().next(stone);
        } while (stone != beside);
    }
}

template <int most_size>
template <Colour colour>
void SoftmaxPolicy<most_size>::move(int at) {
    note_freed<colour>(at);
    const int taken = position_.template play<colour>(at);
    weigh_around(at);
    for (int i = 0; i < taken; ++i) weigh_around(board().newly_empty(i));
    for (const int freed : freed_) weigh(freed);
    if (board().in_atari(at)) weigh(board().last_liberty(at));
    for (const int beside : Board::neighbours(at))
        if (board().at(beside) == opponent(colour) && board().in_atari(beside))
            weigh(board().last_liberty(beside));
}

template <int most_size>
template <Colour colour>
std::vector<std::pair<int, double>> SoftmaxPolicy<most_size>::chances() {
    find_answers<colour>();
    const Side& side = sides_[side_of(colour)];
    const double total = answers_total_ + static_cast<double>(side.total - answers_usual_);
    std::vector<std::pair<int, double>> result;
    for (std::size_t at = 0; at < cells; ++at)
        if (side.weights[at] != 0 && answered_[at] == 0)
            result.emplace_back(static_cast<int>(at),
                                static_cast<double>(side.weights[at]) / total);
    for (std::size_t i = 0; i < answer_count_; ++i)
        if (answers_[i].weight > 0) result.emplace_back(answers_[i].at, answers_[i].weight / total);
    return result;
}

}  // namespace go
