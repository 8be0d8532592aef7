#include "engine/shogi/kif.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "engine/base/charset.h"
#include "engine/base/text.h"
#include "engine/shogi/kif_words.h"
#include "engine/shogi/sfen.h"

namespace shogi::kif {
namespace {

std::string_view name_of(Kind kind) {
    return std::find_if(kinds.begin(), kinds.end(),
                        [kind](const NamedKind& named) { return named.kind == kind; })
        ->name;
}

std::string_view diagram_name_of(Kind kind) {
    for (const auto& [name, named] : diagram_kinds)
        if (named == kind) return name;
    return name_of(kind);
}

std::string_view kanji_digit(int digit) { return kanji_digits[static_cast<std::size_t>(digit)]; }
std::string_view wide_digit(int digit) { return wide_digits[static_cast<std::size_t>(digit)]; }

std::string kanji_number(int number) {
    std::string text;
    if (number >= 20) text += kanji_digit(number / 10);
    if (number >= 10) text += kanji_digit(10);
    if (number % 10 != 0) text += kanji_digit(number % 10);
    return text;
}

std::string_view handicap_of(const Position& position) {
    for (const auto& [name, sfen] : handicaps)
        if (parse_sfen(sfen).position == position) return name;
    return {};
}

std::string hand_of(const Position& position, Player player) {
    std::string text;
    for (auto kind = hand_kinds.rbegin(); kind != hand_kinds.rend(); ++kind) {
        const int pieces = position.hand(player, *kind);
        if (pieces == 0) continue;
        text += name_of(*kind);
        if (pieces > 1) text += kanji_number(pieces);
        text += "　";
    }
    return text.empty() ? "なし" : text;
}

void append_diagram(std::string& text, const Position& position) {
    text += "後手の持駒：" + hand_of(position, Player::second) + "\n";
    text += "  ９ ８ ７ ６ ５ ４ ３ ２ １\n+---------------------------+\n";
    for (int rank = 0; rank < board_size; ++rank) {
        text += '|';
        for (int file = board_size - 1; file >= 0; --file) {
            const Piece piece = position.at(square_at(file, rank));
            text += !piece.empty() && piece.player() == Player::second ? 'v' : ' ';
            text += piece.empty() ? "・" : diagram_name_of(piece.kind());
        }
        text.append("|").append(kanji_digit(rank + 1)) += '\n';
    }
    text += "+---------------------------+\n先手の持駒：" + hand_of(position, Player::first) + "\n";
    if (position.to_play() == Player::second) text += "後手番\n";
}

void append_heading(std::string& text, std::string_view name, std::string_view value) {
    text.append(name).append("：").append(value.substr(0, value.find('\n'))) += '\n';
}

void append_headings(std::string& text, const Record& record) {
    for (const auto& [name, value] : record.facts) append_heading(text, name, value);
    const Position& start = record.start.position();
    const auto handicap = handicap_of(start);
    if (handicap.empty())
        append_diagram(text, start);
    else
        append_heading(text, "手合割", handicap);
    const bool even = handicap.empty() || handicap == handicaps[0].name;
    append_heading(text, even ? "先手" : "下手", record.black);
    append_heading(text, even ? "後手" : "上手", record.white);
    text += "手数----指手---------消費時間--\n";
}

void append_comment(std::string& text, std::string_view comment) {
    while (!comment.empty()) {
        const auto end = comment.find('\n');
        text.append("*").append(comment.substr(0, end)) += '\n';
        comment.remove_prefix(end == comment.npos ? comment.size() : end + 1);
    }
}

// The lines of a record one after the other: the main line, then the variations, the last ones of
// each line first, as the reader of KIF expects.
class LineWriter {
   public:
    LineWriter(std::string& text, const Record& record) : text_(text), record_(record) {}

    void write_all() {
        append_comment(text_, record_.nodes[0].comment);
        line({record_.start.position(), 0, 0, 1});
        while (!variations_.empty()) {
            const auto variation = variations_.back();
            variations_.pop_back();
            text_ += fmt::format("\n変化：{}手\n", variation.number);
            line(variation);
        }
    }

   private:
    // The child of a node from which a line goes on.
    struct Place {
        Position position;
        std::uint32_t node;
        std::size_t child;
        int number;
    };

    void line(Place at) {
        while (at.child < record_.nodes[at.node].children.size()) {
            const auto& siblings = record_.nodes[at.node].children;
            if (at.child + 1 < siblings.size()) {
                variations_.push_back(at);
                ++variations_.back().child;
            }
            const auto child = siblings[at.child];
            move(at, record_.nodes[child], at.child + 1 < siblings.size());
            at.position.play(record_.nodes[child].move);
            at = {at.position, child, 0, at.number + 1};
        }
        ending(record_.nodes[at.node].ending, at.number);
    }

    void move(const Place& at, const Node& node, bool branches) {
        const int seconds = node.seconds.value_or(0);
        const auto mover = index(at.position.to_play());
        if (at.number == 1) used_ = {};
        used_[mover] += seconds;
        text_ += fmt::format("{:4} {}", at.number,
                             to_kif(at.position, node.move, record_.nodes[at.node].move));
        if (node.seconds)
            text_ += fmt::format("   ({:2}:{:02}/{:02}:{:02}:{:02})", seconds / 60, seconds % 60,
                                 used_[mover] / 3600, used_[mover] / 60 % 60, used_[mover] % 60);
        text_ += branches ? "+\n" : "\n";
        append_comment(text_, node.comment);
    }

    void ending(Ending ending, int number) {
        const auto* const found =
            std::find_if(endings.begin(), endings.end(),
                         [ending](const NamedEnding& named) { return named.ending == ending; });
        if (found != endings.end()) text_ += fmt::format("{:4} {}\n", number, found->name);
    }

    std::string& text_;
    const Record& record_;
    std::vector<Place> variations_;
    std::array<int, 2> used_{};  // seconds, in the line being written
};

std::string written(const Record& record, std::string_view charset) {
    auto text = fmt::format("#KIF version=2.0 encoding={}\n", charset);
    append_headings(text, record);
    LineWriter(text, record).write_all();
    return text;
}

}  // namespace

std::string to_kif(const Position& position, Move move, Move before) {
    const int to = to_square(move);
    std::string text;
    if (before != Move{} && to_square(before) == to)
        text = "同　";
    else
        text.append(wide_digit(file_of(to) + 1)).append(kanji_digit(rank_of(to) + 1));
    if (is_drop(move)) return text.append(name_of(dropped_kind(move))).append("打");
    const int from = from_square(move);
    text.append(name_of(position.at(from).kind()));
    if (is_promotion(move)) text += "成";
    return text + fmt::format("({}{})", file_of(from) + 1, rank_of(from) + 1);
}

std::string to_text(const Record& record) { return written(record, "UTF-8"); }

std::string to_shift_jis(const Record& record) {
    return engine::from_utf8(written(record, "Shift_JIS"), "Shift_JIS");
}

}  // namespace shogi::kif
