#include "engine/go/score.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace go {

namespace {

using Owners = std::array<Colour, 1024>;  // by the board's indices

// The chains of one colour that can never be captured (D. Benson, "Life in the game of Go",
// 1976), and the regions around them.
class PassAlive {
   public:
    PassAlive(const Board& board, Colour colour, bool suicide)
        : board_(board), colour_(colour), suicide_(suicide) {
        board_.for_each_point([this](int at) {
            if (board_.at(at) == colour_)
                alive_.set(index(board_.head(at)));
            else if (!seen_[index(at)])
                collect(at);
        });
        while (drop_chains() || drop_regions()) {
        }
    }

    // Writes the colour to all points that it owns for certain.
    void claim(Owners& owners) const {
        board_.for_each_point([&](int at) {
            if (board_.at(at) == colour_ && alive_[index(board_.head(at))])
                owners[index(at)] = colour_;
        });
        for (const auto& region : regions_)
            if (region.enclosed && (region.deep <= 1 || !region.enemy))
                for (const int at : region.points) owners[index(at)] = colour_;
    }

   private:
    // Connected points without a stone of the colour.
    struct Region {
        std::vector<int> points;
        std::vector<int> chains;  // heads of those around it
        std::vector<int>
            vital;     // those of them that have a liberty in every point that must be one
        int deep = 0;  // points beside no stone of the colour
        bool enemy = false;
        bool enclosed = true;  // all chains around it are alive, and there is one
    };

    static std::size_t index(int at) { return static_cast<std::size_t>(at); }

    std::vector<int> chains_beside(int at) const {
        std::vector<int> heads;
        for (const int beside : board_.neighbours(at))
            if (board_.at(beside) == colour_) heads.push_back(board_.head(beside));
        return heads;
    }

    void collect(int start) {
        Region region;
        region.points.push_back(start);
        seen_.set(index(start));
        for (std::size_t i = 0; i < region.points.size(); ++i)
            for (const int beside : board_.neighbours(region.points[i])) {
                const auto there = board_.at(beside);
                if (there == colour_ || there == Colour::edge || seen_[index(beside)]) continue;
                seen_.set(index(beside));
                region.points.push_back(beside);
            }
        describe(region);
        regions_.push_back(std::move(region));
    }

    void describe(Region& region) const {
        bool first = true;
        for (const int at : region.points) {
            const auto heads = chains_beside(at);
            const auto is_beside = [&](int head) {
                return std::find(heads.begin(), heads.end(), head) != heads.end();
            };
            region.deep += heads.empty();
            region.enemy = region.enemy || board_.at(at) != Colour::empty;
            region.chains.insert(region.chains.end(), heads.begin(), heads.end());
            // Where suicide is allowed, the enemy's stones may turn into empty points.
            if (!suicide_ && board_.at(at) != Colour::empty) continue;
            if (std::exchange(first, false))
                region.vital = heads;
            else
                std::erase_if(region.vital, [&](int head) { return !is_beside(head); });
        }
        for (auto* heads : {&region.chains, &region.vital}) {
            std::sort(heads->begin(), heads->end());
            heads->erase(std::unique(heads->begin(), heads->end()), heads->end());
        }
        region.enclosed = !region.chains.empty();
    }

    // A chain needs two enclosed regions that are vital to it.
    bool drop_chains() {
        std::array<int, 1024> eyes{};
        for (const auto& region : regions_)
            if (region.enclosed)
                for (const int head : region.vital) ++eyes[index(head)];
        bool changed = false;
        for (std::size_t head = 0; head < eyes.size(); ++head)
            if (alive_[head] && eyes[head] < 2) {
                alive_.reset(head);
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

// Who owns each point of the board as it stands.
Owners all_owners(const Go& game) {
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

std::vector<std::optional<Player>> pass_alive(const Go& game) {
    return in_order(game.board(), pass_alive_owners(game));
}

Score score(const Go& game, std::span<const Point> dead) {
    Go cleared = game;
    for (const Point point : dead) cleared.take_dead(point);
    const auto owners = all_owners(cleared);
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
