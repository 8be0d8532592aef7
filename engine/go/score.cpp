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

// The stones and what is empty.
struct StoneRows {
    explicit StoneRows(const Board& board)
        : black(board, Colour::black), white(board, Colour::white), empty(board, Colour::empty) {}
    const PointRows& of(Colour colour) const { return colour == Colour::black ? black : white; }

    PointRows black, white, empty;
};

// The chains of one colour that can never be captured (D. Benson, "Life in the game of Go",
// 1976), and the regions around them.
class PassAlive {
   public:
    PassAlive(const Board& board, const StoneRows& stones, Colour colour, bool suicide)
        : board_(board), colour_(colour), own_(stones.of(colour)), empty_(stones.empty) {
        auto rest = empty_ | stones.of(opponent(colour));
        while (rest.any()) {
            Region region{rest.one().joined(rest)};
            rest -= region.points;
            // Where suicide is allowed, the enemy's stones may turn into empty points.
            find_vital(region, suicide ? region.points : region.points & empty_);
            regions_.push_back(std::move(region));
        }
        for (const auto& region : regions_)
            for (const int head : region.vital) alive_.set(index(head));
        // Mostly no chain has two eyes, and nothing else needs to be known.
        drop_chains();
        if (alive_.none()) return;
        for (auto& region : regions_) describe(region);
        while (drop_regions() && drop_chains()) {
        }
    }

    // All points that the colour owns for certain.
    PointRows owned() const {
        PointRows owned(board_.size());
        if (alive_.none()) return owned;
        own_.for_each([&](int x, int y) {
            if (alive_[index(board_.head(board_.index(x, y)))]) owned.set(x, y);
        });
        for (const auto& region : regions_)
            if (region.enclosed && (region.deep <= 1 || !region.enemy)) owned |= region.points;
        return owned;
    }

   private:
    // Connected points without a stone of the colour.
    struct Region {
        PointRows points;
        Heads vital;  // chains around it that have a liberty in every point that must be one
        std::vector<int> chains{};  // heads of all around it
        int deep = 0;               // points beside no stone of the colour
        bool enemy = false;
        bool enclosed = true;  // all chains around it are alive, and there is one
    };

    static std::size_t index(int at) { return static_cast<std::size_t>(at); }

    Heads chains_beside(int at) const {
        Heads heads;
        for (const int beside : board_.neighbours(at))
            if (board_.at(beside) == colour_) heads.add(board_.head(beside));
        return heads;
    }
    PointRows chain(int head) const {
        PointRows stone(board_.size());
        stone.set(board_.x(head), board_.y(head));
        return stone.joined(own_);
    }

    // `must`: the points of the region that must be liberties.
    void find_vital(Region& region, const PointRows& must) const {
        if (!must.any() || (must - own_.beside()).any()) return;
        must.one().for_each(
            [&](int x, int y) { region.vital = chains_beside(board_.index(x, y)); });
        for (std::size_t i = region.vital.size(); i-- > 0;)
            if ((must - chain(region.vital[i]).beside()).any()) region.vital.remove(i);
    }

    void describe(Region& region) const {
        region.deep = (region.points - own_.beside()).count();
        region.enemy = (region.points - empty_).any();
        (region.points.beside() & own_).for_each([&](int x, int y) {
            region.chains.push_back(board_.head(board_.index(x, y)));
        });
        region.enclosed = !region.chains.empty();
    }

    // A chain needs two enclosed regions that are vital to it.
    bool drop_chains() {
        std::bitset<1024> one_eye, two_eyes;
        for (const auto& region : regions_)
            if (region.enclosed)
                for (const int head : region.vital)
                    (one_eye[index(head)] ? two_eyes : one_eye).set(index(head));
        return alive_ != std::exchange(alive_, alive_ & two_eyes);
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
    const PointRows& own_;
    const PointRows& empty_;
    std::bitset<1024> alive_;
    std::vector<Region> regions_;
};

Owners pass_alive_owners(const Go& game, const StoneRows& stones) {
    const auto owned = [&](Colour colour) {
        return PassAlive(game.board(), stones, colour, game.rules().suicide).owned();
    };
    return {owned(Colour::black), owned(Colour::white)};
}

bool in_seki(const Board& board, const PointRows& own, const PointRows& component,
             const PointRows& dame) {
    if ((component.beside() & dame).any()) return true;
    bool in_atari = false;
    (component & own).for_each([&](int x, int y) {
        in_atari = in_atari || board.liberties(board.index(x, y), 2) < 2;
    });
    return in_atari;
}

// What all that `player` owns is worth, prisoners taken earlier aside.
int points_of(const Go& game, const StoneRows& stones, const Owners& owners, Player player) {
    const auto& own = stones.of(colour_of(player));
    const auto& enemy = stones.of(colour_of(~player));
    const auto& owned = owners[player == Player::first ? 0 : 1];
    const auto dame = stones.empty - owners[0] - owners[1];
    const bool territory = game.rules().scoring == Scoring::territory;
    const auto tax = game.rules().tax;
    int points = 0;
    for (auto rest = owned; rest.any();) {
        const auto component = rest.one().joined(rest);
        rest -= component;
        points += (component & (territory ? enemy : own)).count();
        if (tax != Tax::none && in_seki(game.board(), own, component, dame)) continue;
        points += (component - own).count() - (tax == Tax::all ? 2 : 0);
    }
    return points;
}

int board_lead(const Go& game, const StoneRows& stones, const Owners& owners) {
    const int lead = points_of(game, stones, owners, Player::first) -
                     points_of(game, stones, owners, Player::second);
    if (game.rules().scoring == Scoring::area) return lead;
    return lead + game.captured_by(Player::first) - game.captured_by(Player::second);
}

std::vector<std::optional<Player>> in_order(const Board& board, const Owners& owners) {
    std::vector<std::optional<Player>> result(
        static_cast<std::size_t>(board.size() * board.size()));
    for (const auto player : {Player::first, Player::second})
        owners[player == Player::first ? 0 : 1].for_each(
            [&](int x, int y) { result[board.order(board.index(x, y))] = player; });
    return result;
}

Owners area_owners(const Go& game, const StoneRows& stones) {
    Owners owners = pass_alive_owners(game, stones);
    const auto certain = owners[0] | owners[1];
    for (const auto colour : {Colour::black, Colour::white})
        owners[colour == Colour::black ? 0 : 1] |= stones.of(colour) - certain;
    for (auto rest = stones.empty; rest.any();) {
        const auto region = rest.one().joined(rest);
        rest -= region;
        const auto beside = region.beside();
        const bool black = (beside & stones.of(Colour::black)).any();
        const bool white = (beside & stones.of(Colour::white)).any();
        // The only colour that it touches, if there is one.
        if (black != white) owners[black ? 0 : 1] |= region - certain;
    }
    return owners;
}

}  // namespace

Owners area_owners(const Go& game) { return area_owners(game, StoneRows(game.board())); }

std::vector<std::optional<Player>> pass_alive(const Go& game) {
    return in_order(game.board(), pass_alive_owners(game, StoneRows(game.board())));
}

Score score(const Go& game, std::span<const Point> dead) {
    Go cleared = game;
    for (const Point point : dead) cleared.take_dead(point);
    const StoneRows stones(cleared.board());
    const auto owners = area_owners(cleared, stones);
    Score result;
    result.owners = in_order(cleared.board(), owners);
    result.lead_halves =
        2 * (board_lead(cleared, stones, owners) - game.white_bonus()) - game.komi().halves();
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
