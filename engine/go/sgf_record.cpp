#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/go/sgf.h"

namespace go::sgf {

namespace {

constexpr int most_turns = 1 << 16, most_set_ups = 1 << 10;
constexpr int largest_board_with_tt = 19;  // there "tt" is a pass

std::optional<Player> mover_of(const Property& property) {
    if (property.id == "B") return Player::first;
    if (property.id == "W") return Player::second;
    return {};
}

std::optional<Player> first_mover(const Node& node) {
    for (const auto& property : node.properties)
        if (const auto mover = mover_of(property)) return mover;
    return {};
}

std::optional<int> whole_number(std::string_view text) {
    int value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc{} || end != text.data() + text.size()) return {};
    return value;
}

std::optional<double> number(std::string_view text) {
    std::string digits(text.substr(text.starts_with('+') ? 1 : 0));
    std::replace(digits.begin(), digits.end(), ',', '.');
    double value = 0;
    const auto* const last = digits.data() + digits.size();
    const auto [end, status] = std::from_chars(digits.data(), last, value);
    if (status != std::errc{} || end != last || !std::isfinite(value)) return {};
    return value;
}

bool is_multiple(double value, double of) { return std::floor(value / of) * of == value; }

// See main_line in sgf.h.
std::optional<Komi> komi_from(std::string_view text) {
    auto value = number(text);
    if (!value) return {};
    const bool hundredths = text.find_first_of(".,") == text.npos && *value >= 200;
    if (hundredths) *value /= 100;
    if (!is_multiple(*value, 0.5) && is_multiple(*value, 0.25)) *value *= 2;
    if (std::abs(*value) > 1000) return {};
    return Komi::from_halves(static_cast<int>(std::lround(*value * 2)));
}

int size_from(std::string_view text) {
    if (text.empty()) return largest_board_with_tt;
    const auto colon = text.find(':');
    const auto columns = whole_number(engine::trimmed(text.substr(0, colon)));
    const auto rows =
        colon == text.npos ? columns : whole_number(engine::trimmed(text.substr(colon + 1)));
    if (!columns || !rows) engine::fail("SZ[{}] is no board size", engine::excerpt(text));
    if (*columns != *rows) engine::fail("SZ[{}]: the board is not square", engine::excerpt(text));
    if (*columns < min_size || *columns > max_size)
        engine::fail("SZ[{}]: the size must lie in {}..{}", engine::excerpt(text), min_size,
                     max_size);
    return *columns;
}

std::optional<Rules> rules_from(std::string_view text) {
    try {
        return rules_from_text(text);
    } catch (const engine::Error&) {
        return {};
    }
}

// "pd", from the top left corner.
std::optional<Point> point_from(std::string_view text, int size) {
    if (text.size() != 2) return {};
    const int x = text[0] - 'a', y = size - 1 - (text[1] - 'a');
    if (x < 0 || x >= size || y < 0 || y >= size) return {};
    return Point{x, y};
}

// The stones that one node puts or takes, the last word on a point counting.
class SetUp {
   public:
    explicit SetUp(int size) : size_(size) {}

    // A point or a rectangle "aa:cc"; false when it is neither.
    bool add(std::string_view text, char stone) {
        const auto colon = text.find(':');
        const auto from = point_from(engine::trimmed(text.substr(0, colon)), size_);
        const auto to =
            colon == text.npos ? from : point_from(engine::trimmed(text.substr(colon + 1)), size_);
        if (!from || !to) return false;
        for (int y = std::min(from->y, to->y); y <= std::max(from->y, to->y); ++y)
            for (int x = std::min(from->x, to->x); x <= std::max(from->x, to->x); ++x)
                change_at({x, y}) = stone;
        return true;
    }

    // True when the board changed.
    bool apply(Go& game) const {
        bool changed = false;
        for (int y = 0; y < size_; ++y)
            for (int x = 0; x < size_; ++x) changed = put(game, {x, y}) || changed;
        return changed;
    }

    static constexpr char untouched = 0, empty = 'E', black = 'B', white = 'W';

   private:
    char& change_at(Point point) {
        return change_[static_cast<std::size_t>(point.y)][static_cast<std::size_t>(point.x)];
    }
    char change_at(Point point) const {
        return change_[static_cast<std::size_t>(point.y)][static_cast<std::size_t>(point.x)];
    }
    bool put(Go& game, Point point) const {
        const char change = change_at(point);
        if (change == untouched) return false;
        std::optional<Player> stone;
        if (change != empty) stone = change == black ? Player::first : Player::second;
        if (game.at(point) == stone) return false;
        game.set_up(point, stone);
        return true;
    }

    int size_;
    std::array<std::array<char, max_size>, max_size> change_{};  // rows from the bottom
};

bool is_set_up(std::string_view id) { return id == "AB" || id == "AW" || id == "AE"; }

class Replay {
   public:
    explicit Replay(const Tree& tree) : tree_(tree) {
        if (tree.nodes.empty()) engine::fail("a game tree without nodes");
        for (std::uint32_t at = 0;; at = tree.nodes[at].children.front()) {
            line_.push_back(&tree.nodes[at]);
            if (tree.nodes[at].children.empty()) break;
        }
    }

    Record run(int most_moves) {
        read_root();
        for (const auto* const node : line_) {
            if (turns_ >= most_moves && first_mover(*node)) break;
            set_up(*node);
            play(*node, most_moves);
        }
        record_.end = std::move(game_);
        return std::move(record_);
    }

   private:
    const Node& root() const { return *line_.front(); }

    template <class... Parts>
    void note(fmt::format_string<Parts...> text, Parts&&... parts) {
        record_.notes.push_back(fmt::format(text, std::forward<Parts>(parts)...));
    }

    // Of the move that comes next.
    template <class... Parts>
    [[noreturn]] void refuse(fmt::format_string<Parts...> text, Parts&&... parts) const {
        engine::fail("move {}: {}", turns_ + 1, fmt::format(text, std::forward<Parts>(parts)...));
    }

    void read_root() {
        const auto kind = engine::trimmed(root().value("GM"));
        if (!kind.empty() && whole_number(kind) != 1)
            engine::fail("GM[{}] is not Go, which is GM[1]", engine::excerpt(kind));
        const int size = size_from(engine::trimmed(root().value("SZ")));
        const auto rules = read_rules();
        game_ = Go(size, read_komi(rules), rules);
        record_.start = game_;
        record_.result = root().value("RE");
        read_handicap();
        if (const auto mover = opening_mover()) game_.set_to_play(*mover);
        record_.start = game_;
    }

    Rules read_rules() {
        const auto text = engine::trimmed(root().value("RU"));
        if (text.empty()) return {};
        const auto rules = rules_from(text);
        if (!rules) note("RU[{}] is not known: chinese rules", engine::excerpt(text));
        return rules.value_or(Rules{});
    }

    static Komi usual_komi(const Rules& rules) {
        for (const auto& named : named_rules())
            if (named.rules == rules) return Komi::from_points(named.usual_komi);
        return {};
    }

    Komi read_komi(const Rules& rules) {
        const auto text = engine::trimmed(root().value("KM"));
        if (text.empty()) return usual_komi(rules);
        const auto komi = komi_from(text).value_or(usual_komi(rules));
        if (number(text) != komi.points())
            note("KM[{}]: komi {}", engine::excerpt(text), komi.points());
        return komi;
    }

    void read_handicap() {
        const auto text = engine::trimmed(root().value("HA"));
        if (text.empty()) return;
        const auto stones = whole_number(text);
        if (!stones || *stones < 0 || *stones >= game_.size() * game_.size())
            return note("HA[{}]: no handicap", engine::excerpt(text));
        if (*stones < 2) return;
        game_.set_handicap(*stones);
        if (!stones_come_later()) place_handicap(*stones);
    }

    // Are handicap stones set up, or Black's own moves?
    bool stones_come_later() const {
        for (const auto* const node : line_) {
            if (node->find("AB")) return true;
            if (const auto mover = first_mover(*node)) return mover == Player::first;
        }
        return true;
    }

    void place_handicap(int stones) {
        if (stones > most_fixed_handicap(game_.size()))
            return note("HA[{}] without AB: no stones", stones);
        note("HA[{}] without AB: on the fixed points", stones);
        for (const auto point : fixed_handicap(game_.size(), stones))
            game_.set_up(point, Player::first);
    }

    // Where PL does not say it: who makes the first move, or White after handicap stones.
    std::optional<Player> opening_mover() const {
        for (const auto* const node : line_)
            if (const auto mover = first_mover(*node)) return mover;
        const bool black_only = root().find("AB") && !root().find("AW");
        if (game_.handicap() >= 2 || black_only) return Player::second;
        return {};
    }

    // Set-up starts the record anew, as it does the game's history.
    void set_up(const Node& node) {
        SetUp stones(game_.size());
        for (const auto& property : node.properties)
            if (is_set_up(property.id)) add(stones, property);
        const auto before = game_.to_play();
        const bool changed = stones.apply(game_);
        if (changed && !game_.every_chain_has_liberty())
            refuse("the set-up leaves a chain without liberty");
        if (!first_mover(node)) set_mover(engine::trimmed(node.value("PL")));
        if (!changed && game_.to_play() == before) return;
        if (++set_ups_ > most_set_ups) refuse("more than {} set-ups", most_set_ups);
        record_.start = game_;
        record_.moves_before = turns_;
        record_.turns.clear();
    }

    void add(SetUp& stones, const Property& property) const {
        for (const auto& value : property.values) {
            const auto text = engine::trimmed(value);
            const bool none = text.empty() && property.values.size() == 1;
            if (!none && !stones.add(text, property.id[1]))
                refuse("{}[{}] is no point of the board", property.id, engine::excerpt(text));
        }
    }

    void set_mover(std::string_view text) {
        if (text.empty()) return;
        const char colour = engine::to_lower(text.front());
        if (colour == 'b' || text == "1") return game_.set_to_play(Player::first);
        if (colour == 'w' || text == "2") return game_.set_to_play(Player::second);
        refuse("PL[{}] is neither B nor W", engine::excerpt(text));
    }

    void play(const Node& node, int most_moves) {
        for (const auto& property : node.properties) {
            const auto mover = mover_of(property);
            if (!mover || turns_ >= most_moves) continue;
            if (property.values.size() != 1) refuse("{} with several points", property.id);
            play(*mover, property.id, engine::trimmed(property.values.front()));
        }
    }

    void play(Player mover, std::string_view id, std::string_view text) {
        if (turns_ >= most_turns) refuse("more than {} moves", most_turns);
        const auto move = move_from(text);
        if (!move) refuse("{}[{}] is no point of the board", id, engine::excerpt(text));
        game_.set_to_play(mover);
        const auto why_not = game_.why_illegal(*move);
        if (!why_not.empty()) refuse("{}[{}] is illegal: {}", id, text, why_not);
        game_.play(*move);
        record_.turns.push_back({mover, *move});
        ++turns_;
    }

    std::optional<Move> move_from(std::string_view text) const {
        const bool pass = text.empty() || (text == "tt" && game_.size() <= largest_board_with_tt);
        if (pass) return Go::pass;
        const auto point = point_from(text, game_.size());
        return point ? std::optional(game_.move_at(*point)) : std::nullopt;
    }

    const Tree& tree_;
    std::vector<const Node*> line_;
    Go game_;
    Record record_;
    int turns_ = 0, set_ups_ = 0;
};

}  // namespace

Record main_line(const Tree& tree, int most_moves) { return Replay(tree).run(most_moves); }

Outcome outcome_of(const Record& record) {
    const std::string_view result = record.result;
    if (result.starts_with('B')) return Outcome::first_wins;
    if (result.starts_with('W')) return Outcome::second_wins;
    return result == "0" || result.starts_with('D') ? Outcome::draw : Outcome::ongoing;
}

bool is_even(const Record& record) {
    const auto& stones = record.start.board().stones();
    if (record.moves_before > 0 || record.start.handicap() > 1 || stones[0].any() ||
        stones[1].any())
        return false;
    auto player = Player::first;
    for (const auto& turn : record.turns) {
        if (turn.player != player) return false;
        player = ~player;
    }
    return true;
}

}  // namespace go::sgf
