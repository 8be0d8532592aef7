#include <algorithm>
#include <charconv>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/shogi/kif.h"
#include "engine/shogi/kif_move.h"
#include "engine/shogi/kif_words.h"
#include "engine/shogi/sfen.h"

namespace shogi::kif {
namespace {

using engine::excerpt;
using engine::fail;

constexpr std::string_view colon = "：";

std::string_view without_blanks(std::string_view text) {
    constexpr std::string_view wide_blank = "　";
    for (auto before = text.size() + 1; before != text.size();) {
        before = text.size();
        text = engine::trimmed(text);
        if (text.starts_with(wide_blank)) text.remove_prefix(wide_blank.size());
        if (text.ends_with(wide_blank)) text.remove_suffix(wide_blank.size());
    }
    return text;
}

// 1 to 99 in kanji, as in 十七; 1 where there is none.
int take_kanji_number(Scanner& scanner) {
    const auto tens = scanner.take_digit();
    if (!scanner.take("十")) return tens.value_or(1);
    return tens.value_or(1) * 10 + scanner.take_digit().value_or(0);
}

// The start of a game: a handicap by name, or a diagram with hands.
class SetUp {
   public:
    // False when the line is no part of a set-up.
    bool heading(std::string_view name, std::string_view value) {
        if (name == "手合割") return handicap(value);
        const bool black = name == "先手の持駒" || name == "下手の持駒";
        if (!black && name != "後手の持駒" && name != "上手の持駒") return false;
        hand(black ? Player::first : Player::second, value);
        return true;
    }

    bool line(std::string_view text) {
        if (text.starts_with("|")) return rank(text), true;
        if (text == "後手番" || text == "上手番") return mover_ = Player::second, true;
        if (text == "先手番" || text == "下手番") return mover_ = Player::first, true;
        return text.starts_with("+---") || text.starts_with("９");
    }

    Shogi finish() {
        if (ranks_ == 0) return start_;
        if (ranks_ != board_size) fail("a board of {} ranks", ranks_);
        position_.set_to_play(mover_.value_or(Player::first));
        check(position_);
        return Shogi(position_);
    }

   private:
    bool handicap(std::string_view name) {
        for (const auto& [known, sfen] : handicaps)
            if (name == known) start_ = Shogi::from_text(sfen);
        return true;
    }

    void hand(Player player, std::string_view text) {
        Scanner scanner(text);
        for (scanner.skip_blanks(); !scanner.rest().empty(); scanner.skip_blanks()) {
            if (scanner.take("なし")) continue;
            const auto kind = scanner.take_kind();
            if (!kind || *kind >= Kind::king) fail("no pieces in hand: {}", excerpt(text));
            if (*kind == Kind::rook) scanner.take("車");
            const int pieces = take_kanji_number(scanner);
            if (pieces > full_set[index(*kind)]) fail("too many pieces in hand");
            position_.set_hand(player, *kind, pieces);
        }
    }

    void rank(std::string_view text) {
        if (ranks_ == board_size) fail("a board of more than 9 ranks");
        Scanner scanner(text);
        scanner.take("|");
        for (int file = board_size - 1; file >= 0; --file) square(scanner, square_at(file, ranks_));
        ++ranks_;
    }

    void square(Scanner& scanner, int square) {
        const bool white = scanner.take("v") || scanner.take("V");
        if (!white && !scanner.take(" ")) scanner.take("^");
        if (scanner.take("・") || scanner.take("　")) return;
        const auto kind = scanner.take_kind();
        if (!kind) fail("no piece on the board: {}", excerpt(scanner.rest()));
        position_.put(square, {white ? Player::second : Player::first, *kind});
    }

    Shogi start_;
    Position position_;
    int ranks_ = 0;
    std::optional<Player> mover_;
};

// "( 0:21/00:00:21)": what stands before the slash, in seconds.
std::optional<int> take_time(Scanner& scanner) {
    scanner.skip_blanks();
    if (!scanner.take("(")) return std::nullopt;
    int seconds = 0;
    for (int parts = 0; parts < 3; ++parts) {
        scanner.skip_blanks();
        const auto text = scanner.rest();
        int part = 0;
        const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), part);
        if (status != std::errc{} || part < 0 || part > 1'000'000) return std::nullopt;
        scanner.take(text.substr(0, static_cast<std::size_t>(end - text.data())));
        seconds = seconds * 60 + part;
        if (!scanner.take(":")) return seconds;
    }
    return std::nullopt;
}

class GameReader {
   public:
    void line(std::string_view text) {
        if (text.starts_with("*")) return comment(text.substr(1));
        const auto content = without_blanks(text);
        if (content.empty() || content[0] == '#' || content[0] == '&') return;
        if (content.starts_with("変化")) return variation(content);
        if (content.starts_with("まで")) return summary(content);
        if (content.starts_with("手数--")) return begin();
        if (content.starts_with("▲") || content.starts_with("△") || content.starts_with("▽") ||
            content.starts_with("▼") || content.starts_with("☗") || content.starts_with("☖"))
            return moves_in_print(content);
        if (engine::is_digit(content[0]) && !is_heading(content)) return numbered_move(content);
        if (writer_) fail("not understood: {}", excerpt(content));
        heading(content);
    }

    Record finish() {
        begin();
        return std::move(record_);
    }

   private:
    static bool is_heading(std::string_view text) { return text.find(colon) != text.npos; }

    Node& node() { return writer_ ? writer_->node() : record_.nodes[0]; }
    Move last_move() { return node().move; }

    void comment(std::string_view text) {
        auto& comment = node().comment;
        if (!comment.empty()) comment += '\n';
        comment += text;
    }

    void begin() {
        if (writer_) return;
        record_.start = set_up_.finish();
        writer_.emplace(record_);
    }

    void heading(std::string_view text) {
        const auto at = text.find(colon);
        if (at == text.npos) {
            set_up_.line(text);
            return;
        }
        const auto name = text.substr(0, at);
        const auto value = without_blanks(text.substr(at + colon.size()));
        if (name == "先手" || name == "下手")
            record_.black = value;
        else if (name == "後手" || name == "上手")
            record_.white = value;
        else if (!set_up_.heading(name, value))
            record_.facts.push_back({std::string(name), std::string(value)});
    }

    void numbered_move(std::string_view text) {
        begin();
        const auto digits = std::min(text.find_first_not_of("0123456789"), text.size());
        const auto content = without_blanks(text.substr(digits));
        Scanner scanner(content);
        if (ending(scanner)) return;
        move(scanner, content);
        if (const auto seconds = take_time(scanner); seconds && !node().seconds)
            node().seconds = *seconds;
    }

    void move(Scanner& scanner, std::string_view text) {
        const auto move = take_move(scanner, writer_->position(), last_move());
        if (!move) fail("move {} ({}) is none", writer_->number(), excerpt(text));
        writer_->play(*move, excerpt(text));
    }

    bool ending(Scanner& scanner) {
        for (const auto& [name, ending] : endings)
            if (scanner.take(name)) return node().ending = ending, true;
        return false;
    }

    // "▲７六歩 △３四歩 …"
    void moves_in_print(std::string_view text) {
        begin();
        Scanner scanner(text);
        for (scanner.skip_blanks(); !scanner.rest().empty(); scanner.skip_blanks()) {
            bool marked = false;
            for (const auto* const mark : {"▲", "△", "▽", "▼", "☗", "☖"})
                marked |= scanner.take(mark);
            scanner.skip_blanks();
            if (!marked) fail("not understood: {}", excerpt(scanner.rest()));
            // A line of print may end between the mark and the move.
            if (!scanner.rest().empty() && !ending(scanner)) move(scanner, scanner.rest());
        }
    }

    void variation(std::string_view text) {
        begin();
        Scanner scanner(text);
        scanner.take("変化");
        if (!scanner.take(colon)) scanner.take(":");
        scanner.skip_blanks();
        int number = 0;
        const auto digits = scanner.rest();
        std::from_chars(digits.data(), digits.data() + digits.size(), number);
        writer_->go_back_to(number);
    }

    // "まで111手で先手の勝ち": taken at its word where the moves tell no end.
    void summary(std::string_view text) {
        begin();
        if (node().ending != Ending::none) return;
        const auto says = [text](std::string_view word) { return text.find(word) != text.npos; };
        for (const auto& [name, ending] : endings)
            if (says(name)) {
                node().ending = ending;
                return;
            }
        const bool black_moves = writer_->position().to_play() == Player::first;
        if (says(black_moves ? "後手の勝" : "先手の勝") ||
            says(black_moves ? "上手の勝" : "下手の勝"))
            node().ending = Ending::resignation;
    }

    Record record_;
    SetUp set_up_;
    std::optional<RecordWriter> writer_;
};

}  // namespace

Record parse(std::string_view bytes) {
    const std::string text = japanese_text(bytes);
    GameReader reader;
    std::string_view rest = text;
    int number = 0;
    try {
        while (!rest.empty()) {
            ++number;
            const auto end = rest.find('\n');
            reader.line(rest.substr(0, end));
            rest.remove_prefix(end == rest.npos ? rest.size() : end + 1);
        }
        return reader.finish();
    } catch (const engine::Error& error) {
        fail("KIF: line {}: {}", number, error.what());
    }
}

}  // namespace shogi::kif
