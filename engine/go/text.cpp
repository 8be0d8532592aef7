// Go as text: vertices, one-line positions, the board as showboard prints it.
#include <algorithm>
#include <cctype>

#include "engine/base/error.h"
#include "engine/base/option.h"
#include "engine/go/go.h"

namespace go {

namespace {

constexpr std::string_view columns = "ABCDEFGHJKLMNOPQRSTUVWXYZ";

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string_view take_until(std::string_view& text, char separator) {
    const auto end = std::min(text.find(separator), text.size());
    const auto head = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return head;
}

// One row of points: a stone, or nobody's.
std::vector<std::optional<Player>> parse_row(std::string_view row) {
    std::vector<std::optional<Player>> points;
    while (!row.empty() && points.size() <= max_size) {
        const auto digits = static_cast<std::size_t>(
            std::find_if_not(row.begin(), row.end(), is_digit) - row.begin());
        if (digits > 2) engine::fail("bad row of a Go position: {}", row);
        if (digits > 0) {
            points.resize(points.size() + engine::parse_number<std::size_t>(row.substr(0, digits)));
        } else if (row[0] == 'X' || row[0] == 'O') {
            points.emplace_back(row[0] == 'X' ? Player::first : Player::second);
        } else {
            engine::fail("bad row of a Go position: {}", row);
        }
        row.remove_prefix(std::max<std::size_t>(digits, 1));
    }
    return points;
}

Go parse_stones(std::string_view text) {
    const auto size = static_cast<int>(std::count(text.begin(), text.end(), '/')) + 1;
    if (size < min_size || size > max_size)
        engine::fail("a Go board has {} to {} rows, not {}", min_size, max_size, size);
    Go game(size);
    for (int y = size - 1; y >= 0; --y) {
        const auto row = take_until(text, '/');
        const auto points = parse_row(row);
        if (static_cast<int>(points.size()) != size)
            engine::fail("a row of a {0}x{0} Go board has {0} points, unlike {1}", size, row);
        for (int x = 0; x < size; ++x)
            if (const auto stone = points[static_cast<std::size_t>(x)]) game.set_up({x, y}, stone);
    }
    if (!game.every_chain_has_liberty()) engine::fail("a chain has no liberty: {}", text);
    return game;
}

std::string row_text(const Go& game, int y) {
    std::string text;
    int empty = 0;
    const auto flush = [&] {
        if (empty > 0) text += std::to_string(empty);
        empty = 0;
    };
    for (int x = 0; x < game.size(); ++x) {
        const auto stone = game.at({x, y});
        if (!stone) {
            ++empty;
            continue;
        }
        flush();
        text += *stone == Player::first ? 'X' : 'O';
    }
    flush();
    return text;
}

}  // namespace

std::string vertex(Point point) {
    return columns[static_cast<std::size_t>(point.x)] + std::to_string(point.y + 1);
}

std::optional<Point> point_from_vertex(std::string_view text, int size) {
    if (text.size() < 2 || text.size() > 3) return {};
    const auto letter = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    const auto x = columns.find(letter);
    if (x >= static_cast<std::size_t>(size)) return {};
    text.remove_prefix(1);
    if (text[0] == '0' || !std::all_of(text.begin(), text.end(), is_digit)) return {};
    const int row = engine::parse_number<int>(text);
    if (row > size) return {};
    return Point{static_cast<int>(x), row - 1};
}

std::optional<Move> Go::move_from_text(std::string_view text) const {
    if (lower(text) == "pass") return pass;
    const auto point = point_from_vertex(text, size());
    if (!point || !legal(move_at(*point))) return {};
    return move_at(*point);
}

std::string Go::move_to_text(Move move) const {
    const auto point = point_of(move);
    return point ? vertex(*point) : "pass";
}

Go Go::from_text(std::string_view text) {
    Go game = parse_stones(take_until(text, ' '));
    const auto mover = take_until(text, ' ');
    if (mover != "b" && mover != "w" && !mover.empty())
        engine::fail("the player to move is b or w, not {}", mover);
    game.set_to_play(mover == "w" ? Player::second : Player::first);
    const auto ko = take_until(text, ' ');
    const auto prisoners = take_until(text, ' ');
    const auto komi = take_until(text, ' ');
    const auto rules = take_until(text, ' ');
    if (!ko.empty() && ko != "-") {
        const auto point = point_from_vertex(ko, game.size());
        if (!point || game.at(*point)) engine::fail("no ko can be at {}", ko);
        game.ko_ = game.move_at(*point).code;
    }
    if (auto of_white = prisoners; !prisoners.empty()) {
        game.captured_[0] = engine::parse_number<int>(take_until(of_white, ':'));
        game.captured_[1] = engine::parse_number<int>(of_white);
    }
    if (!komi.empty()) game.komi_ = Komi::from_points(engine::parse_number<double>(komi));
    if (!rules.empty()) game.rules_ = rules_from_text(rules);
    if (!text.empty()) game.handicap_ = engine::parse_number<int>(text);
    return game;
}

std::string Go::to_text() const {
    std::string rows = row_text(*this, size() - 1);
    for (int y = size() - 2; y >= 0; --y) rows += '/' + row_text(*this, y);
    return fmt::format("{} {} {} {}:{} {} {} {}", rows, to_play_ == Player::first ? 'b' : 'w',
                       ko_ == 0 ? "-" : move_to_text({ko_}), captured_[0], captured_[1],
                       komi_.points(), describe(rules_), handicap_);
}

std::string diagram(const Go& game) {
    std::string letters = "  ";
    for (int x = 0; x < game.size(); ++x) {
        letters += ' ';
        letters += columns[static_cast<std::size_t>(x)];
    }
    const auto points = game.size() < 7
                            ? std::vector<Point>{}
                            : fixed_handicap(game.size(), most_fixed_handicap(game.size()));
    std::string text = letters + '\n';
    for (int y = game.size() - 1; y >= 0; --y) {
        text += fmt::format("{:2}", y + 1);
        for (int x = 0; x < game.size(); ++x) {
            const auto stone = game.at({x, y});
            const bool star = std::find(points.begin(), points.end(), Point{x, y}) != points.end();
            text += ' ';
            text += !stone ? (star ? '+' : '.') : *stone == Player::first ? 'X' : 'O';
        }
        text += fmt::format(" {}\n", y + 1);
    }
    return text + letters +
           fmt::format(
               "\n{} to play, prisoners: Black {}, White {}\nrules {}, komi {}, handicap {}\n",
               game.to_play() == Player::first ? "Black" : "White", game.captured_by(Player::first),
               game.captured_by(Player::second), describe(game.rules()), game.komi().points(),
               game.handicap());
}

}  // namespace go
