#include "engine/go/score.h"

#include <fmt/format.h>

#include <algorithm>
#include <bitset>
#include <cstdlib>
#include <utility>

namespace go {

namespace {

// A set of up to four: the chains beside a point.
class Heads {
   public:
    void add(int head) {
        if (!holds(head)) heads_[count_++] = head;
    }
    void remove(std::size_t i) { heads_[i] = heads_[--count_]; }
    bool holds(int head) const { return std::find(begin(), end(), head) != end(); }
    const int* begin() const { return heads_.data(); }
    const int* end() const { return heads_.data() + count_; }
    std::size_t size() const { return count_; }
    int operator[](std::size_t i) const { return heads_[i]; }

   private:
    std::array<int, 4> heads_{};
    std::size_t count_ = 0;
};

// The chains of one colour that can never be captured (D. Benson, "Life in the game of Go",
// 1976), and the regions around them.
class PassAlive {
   public:
    PassAlive(const Board& board, Colour colour, bool suicide)
        : board_(board), colour_(colour), suicide_(suicide) {
        board_.for_each_point([this](int at) {
            if (board_.at(at) == colour_) {
                if (board_.head(at) == at) chains_.push_back(at);
            } else if (!seen_[index(at)]) {
                collect(at);
            }
        });
        for (const int chain : chains_) alive_.set(index(chain));
        // Mostly no chain has two eyes, and nothing else needs to be known.
        drop_chains();
        if (alive_.none()) return;
        for (auto& region : regions_) describe(region);
        while (drop_regions() && drop_chains()) {
        }
    }

    // Writes the colour to all points that it owns for certain.
    void claim(Owners& owners) const {
        if (alive_.none()) return;
        board_.for_each_point([&](int at) {
            if (board_.at(at) == colour_ && alive_[index(board_.head(at))])
                owners[index(at)] = colour_;
        });
        for (const auto& region : regions_)
            if (region.enclosed && (region.deep <= 1 || !region.enemy))
                for (const int at : points_of(region)) owners[index(at)] = colour_;
    }

   private:
    // Connected points without a stone of the colour.
    struct Region {
        std::size_t first = 0, end = 0;  // its part of points_
        Heads vital;  // chains around it that have a liberty in every point that must be one
        std::vector<int> chains;  // heads of all around it
        int deep = 0;             // points beside no stone of the colour
        bool enemy = false;
        bool enclosed = true;  // all chains around it are alive, and there is one
    };

    static std::size_t index(int at) { return static_cast<std::size_t>(at); }
    std::span<const int> points_of(const Region& region) const {
        return std::span(points_).subspan(region.first, region.end - region.first);
    }

    Heads chains_beside(int at) const {
        Heads heads;
        for (const int beside : board_.neighbours(at))
            if (board_.at(beside) == colour_) heads.add(board_.head(beside));
        return heads;
    }

    void collect(int start) {
        Region region;
        region.first = points_.size();
        points_.push_back(start);
        seen_.set(index(start));
        for (std::size_t i = region.first; i < points_.size(); ++i)
            for (const int beside : board_.neighbours(points_[i])) {
                const auto there = board_.at(beside);
                if (there == colour_ || there == Colour::edge || seen_[index(beside)]) continue;
                seen_.set(index(beside));
                points_.push_back(beside);
            }
        region.end = points_.size();
        find_vital(region);
        regions_.push_back(std::move(region));
    }

    // Where suicide is allowed, the enemy's stones may turn into empty points.
    bool must_be_liberty(int at) const { return suicide_ || board_.at(at) == Colour::empty; }

    void find_vital(Region& region) const {
        bool first = true;
        for (const int at : points_of(region)) {
            if (!must_be_liberty(at)) continue;
            const auto heads = chains_beside(at);
            if (std::exchange(first, false)) {
                region.vital = heads;
            } else {
                for (std::size_t i = region.vital.size(); i-- > 0;)
                    if (!heads.holds(region.vital[i])) region.vital.remove(i);
            }
            if (region.vital.size() == 0) return;
        }
    }

    void describe(Region& region) const {
        for (const int at : points_of(region)) {
            const auto heads = chains_beside(at);
            region.deep += heads.size() == 0;
            region.enemy = region.enemy || board_.at(at) != Colour::empty;
            region.chains.insert(region.chains.end(), heads.begin(), heads.end());
        }
        region.enclosed = !region.chains.empty();
    }

    // A chain needs two enclosed regions that are vital to it.
    bool drop_chains() {
        std::array<std::uint16_t, 1024> eyes{};
        for (const auto& region : regions_)
            if (region.enclosed)
                for (const int head : region.vital) ++eyes[index(head)];
        bool changed = false;
        for (const int head : chains_)
            if (alive_[index(head)] && eyes[index(head)] < 2) {
                alive_.reset(index(head));
                changed = true;
            }
        return changed;
    }

    bool drop_regions() {
        bool changed = false;
        for (auto& region : regions_) {
            const bool stays = std::all_of(region.chains.begin(), region.chains.end(),
                                           [&](int head) { return alive_[index(head)]; });
            if (stays || !region.enclosed) continue;
            region.enclosed = false;
            changed = true;
        }
        return changed;
    }

    const Board& board_;
    Colour colour_;
    bool suicide_;
    std::bitset<1024> alive_, seen_;
    std::vector<int> chains_, points_;
    std::vector<Region> regions_;
};

Owners pass_alive_owners(const Go& game) {
    Owners owners{};
    for (const auto colour : {Colour::black, Colour::white})
        PassAlive(game.board(), colour, game.rules().suicide).claim(owners);
    return owners;
}

// Connected points that `joins` to the start, in the order they are found.
template <class Joins>
std::vector<int> flood(const Board& board, int start, std::bitset<1024>& seen, Joins joins) {
    std::vector<int> points{start};
    seen.set(static_cast<std::size_t>(start));
    for (std::size_t i = 0; i < points.size(); ++i)
        for (const int beside : board.neighbours(points[i])) {
            if (seen[static_cast<std::size_t>(beside)] || !joins(beside)) continue;
            seen.set(static_cast<std::size_t>(beside));
            points.push_back(beside);
        }
    return points;
}

Colour& owner(Owners& owners, int at) { return owners[static_cast<std::size_t>(at)]; }
Colour owner(const Owners& owners, int at) { return owners[static_cast<std::size_t>(at)]; }

// Whom an empty region belongs to: the only colour it touches, if there is one.
Colour region_owner(const Board& board, const std::vector<int>& region) {
    bool black = false, white = false;
    for (const int at : region)
        for (const int beside : board.neighbours(at)) {
            black = black || board.at(beside) == Colour::black;
            white = white || board.at(beside) == Colour::white;
        }
    if (black == white) return Colour::empty;
    return black ? Colour::black : Colour::white;
}

// Connected points of one owner.
struct Component {
    std::vector<int> points;
    Colour colour;
};

std::vector<Component> components(const Board& board, const Owners& owners) {
    std::vector<Component> all;
    std::bitset<1024> seen;
    board.for_each_point([&](int at) {
        const auto colour = owner(owners, at);
        if (colour == Colour::empty || seen[static_cast<std::size_t>(at)]) return;
        all.push_back({flood(board, at, seen,
                             [&](int point) {
                                 return board.at(point) != Colour::edge &&
                                        owner(owners, point) == colour;
                             }),
                       colour});
    });
    return all;
}

bool in_seki(const Board& board, const Owners& owners, const Component& component) {
    const auto is_dame = [&](int at) {
        return board.at(at) == Colour::empty && owner(owners, at) == Colour::empty;
    };
    return std::any_of(component.points.begin(), component.points.end(), [&](int at) {
        if (board.at(at) == component.colour && board.liberties(at, 2) < 2) return true;
        const auto beside = board.neighbours(at);
        return std::any_of(beside.begin(), beside.end(), is_dame);
    });
}

// What a component is worth to its owner, prisoners taken earlier aside.
int points_of(const Go& game, const Owners& owners, const Component& component) {
    const auto& board = game.board();
    const auto count = [&](Colour colour) {
        return static_cast<int>(std::count_if(component.points.begin(), component.points.end(),
                                              [&](int at) { return board.at(at) == colour; }));
    };
    const bool territory = game.rules().scoring == Scoring::territory;
    const auto tax = game.rules().tax;
    const int own = count(component.colour);
    const int prisoners = count(opponent(component.colour));
    const int stones = territory ? prisoners : own;
    if (tax != Tax::none && in_seki(board, owners, component)) return stones;
    const int inside = static_cast<int>(component.points.size()) - own;
    return stones + inside - (tax == Tax::all ? 2 : 0);
}

int board_lead(const Go& game, const Owners& owners) {
    int lead = 0;
    for (const auto& component : components(game.board(), owners)) {
        const int points = points_of(game, owners, component);
        lead += component.colour == Colour::black ? points : -points;
    }
    if (game.rules().scoring == Scoring::territory)
        lead += game.captured_by(Player::first) - game.captured_by(Player::second);
    return lead;
}

std::vector<std::optional<Player>> in_order(const Board& board, const Owners& owners) {
    std::vector<std::optional<Player>> result;
    board.for_each_point([&](int at) {
        const auto colour = owner(owners, at);
        result.push_back(colour == Colour::empty ? std::nullopt : std::optional(player_of(colour)));
    });
    return result;
}

}  // namespace

Owners area_owners(const Go& game) {
    const auto& board = game.board();
    Owners owners = pass_alive_owners(game);
    std::bitset<1024> seen;
    board.for_each_point([&](int at) {
        if (board.at(at) != Colour::empty) {
            if (owner(owners, at) == Colour::empty) owner(owners, at) = board.at(at);
            return;
        }
        if (seen[static_cast<std::size_t>(at)]) return;
        const auto region =
            flood(board, at, seen, [&](int point) { return board.at(point) == Colour::empty; });
        const auto colour = region_owner(board, region);
        for (const int point : region)
            if (owner(owners, point) == Colour::empty) owner(owners, point) = colour;
    });
    return owners;
}

std::vector<std::optional<Player>> pass_alive(const Go& game) {
    return in_order(game.board(), pass_alive_owners(game));
}

Score score(const Go& game, std::span<const Point> dead) {
    Go cleared = game;
    for (const Point point : dead) cleared.take_dead(point);
    const auto owners = area_owners(cleared);
    Score result;
    result.owners = in_order(cleared.board(), owners);
    result.lead_halves =
        2 * (board_lead(cleared, owners) - game.white_bonus()) - game.komi().halves();
    return result;
}

Outcome Score::outcome() const {
    if (lead_halves == 0) return Outcome::draw;
    return lead_halves > 0 ? Outcome::first_wins : Outcome::second_wins;
}

std::string Score::text() const {
    if (lead_halves == 0) return "0";
    return fmt::format("{}+{:.1f}", lead_halves > 0 ? 'B' : 'W', std::abs(lead_halves) / 2.0);
}

}  // namespace go
