// Go as slow and obvious as can be: every move floods the board anew, every position is kept.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "engine/go/go.h"

namespace go::reference {

class Game {
   public:
    Game(int size, const Rules& rules)
        : size_(size), rules_(rules), stones_(static_cast<std::size_t>(size * size), '.') {
        history_.push_back({stones_, mover_});
    }

    const std::string& stones() const { return stones_; }
    char mover() const { return mover_; }
    int captured_by(char player) const { return player == 'X' ? by_black_ : by_white_; }

    bool legal(int at) const {
        if (stones_[word(at)] != '.') return false;
        const auto after = after_stone(at);
        const auto own = static_cast<int>(std::count(after.begin(), after.end(), mover_));
        const auto before = static_cast<int>(std::count(stones_.begin(), stones_.end(), mover_));
        if (own == before) return false;  // a stone alone
        if (own < before && !rules_.suicide) return false;
        return !forbidden_by_ko(after);
    }

    // -1 passes.
    void play(int at) {
        if (at >= 0) {
            const auto after = after_stone(at);
            const auto gone = [&](char colour) {
                return static_cast<int>(std::count(stones_.begin(), stones_.end(), colour) -
                                        std::count(after.begin(), after.end(), colour));
            };
            by_black_ += gone('O') + (mover_ == 'O');
            by_white_ += gone('X') + (mover_ == 'X');
            stones_ = after;
        }
        mover_ = other(mover_);
        history_.push_back({stones_, mover_});
        no_result_ = at >= 0 && rules_.ko == Ko::simple &&
                     std::count(history_.begin(), history_.end(), history_.back()) >= 3;
    }
    bool no_result() const { return no_result_; }

    std::vector<int> legal_moves() const {
        std::vector<int> moves{-1};
        for (int at = 0; at < size_ * size_; ++at)
            if (legal(at)) moves.push_back(at);
        return moves;
    }

   private:
    using Position = std::pair<std::string, char>;

    static std::size_t word(int at) { return static_cast<std::size_t>(at); }
    static char other(char player) { return player == 'X' ? 'O' : 'X'; }

    std::vector<int> neighbours(int at) const {
        std::vector<int> result;
        if (at % size_ > 0) result.push_back(at - 1);
        if (at % size_ < size_ - 1) result.push_back(at + 1);
        if (at >= size_) result.push_back(at - size_);
        if (at < size_ * (size_ - 1)) result.push_back(at + size_);
        return result;
    }

    // The chain at `at`; its points are marked in `seen`.
    std::vector<int> chain(const std::string& stones, int at, std::vector<bool>& seen) const {
        std::vector<int> points{at};
        seen[word(at)] = true;
        for (std::size_t i = 0; i < points.size(); ++i)
            for (const int beside : neighbours(points[i])) {
                if (stones[word(beside)] != stones[word(at)] || seen[word(beside)]) continue;
                seen[word(beside)] = true;
                points.push_back(beside);
            }
        return points;
    }

    bool has_liberty(const std::string& stones, const std::vector<int>& points) const {
        for (const int at : points)
            for (const int beside : neighbours(at))
                if (stones[word(beside)] == '.') return true;
        return false;
    }

    void take_dead(std::string& stones, char colour) const {
        std::vector<bool> seen(stones.size());
        std::vector<int> dead;
        for (int at = 0; at < size_ * size_; ++at) {
            if (stones[word(at)] != colour || seen[word(at)]) continue;
            const auto points = chain(stones, at, seen);
            if (!has_liberty(stones, points)) dead.insert(dead.end(), points.begin(), points.end());
        }
        for (const int at : dead) stones[word(at)] = '.';
    }

    std::string after_stone(int at) const {
        auto stones = stones_;
        stones[word(at)] = mover_;
        take_dead(stones, other(mover_));
        take_dead(stones, mover_);
        return stones;
    }

    bool forbidden_by_ko(const std::string& after) const {
        if (rules_.ko == Ko::simple)
            return history_.size() >= 2 && history_[history_.size() - 2].first == after;
        return std::any_of(history_.begin(), history_.end(), [&](const Position& position) {
            return position.first == after &&
                   (rules_.ko == Ko::positional || position.second == other(mover_));
        });
    }

    int size_;
    Rules rules_;
    std::string stones_;
    char mover_ = 'X';
    int by_black_ = 0, by_white_ = 0;
    bool no_result_ = false;
    std::vector<Position> history_;
};

}  // namespace go::reference
