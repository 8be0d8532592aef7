#include <algorithm>
#include <array>
#include <utility>

#include "engine/base/error.h"
#include "engine/chess/fen.h"
#include "engine/chess/pgn.h"
#include "engine/chess/san.h"

namespace chess::pgn {

namespace {

constexpr std::array<std::string_view, 7> roster = {"Event", "Site",  "Date",  "Round",
                                                    "White", "Black", "Result"};
constexpr std::size_t widest = 79;

std::string tag_line(std::string_view name, std::string_view value) {
    std::string text = fmt::format("[{} \"", name);
    for (const char letter : value) {
        if (letter == '"' || letter == '\\') text += '\\';
        text += letter == '\n' || letter == '\r' ? ' ' : letter;
    }
    return text + "\"]\n";
}

std::string tag_lines(const Record& record) {
    std::string text;
    for (const auto name : roster) {
        const auto value = record.tag(name);
        const std::string_view unknown = name == "Date" ? "????.??.??" : "?";
        text += tag_line(name, name == "Result" ? record.result : value.empty() ? unknown : value);
    }
    for (const auto& [name, value] : record.tags)
        if (std::find(roster.begin(), roster.end(), name) == roster.end())
            text += tag_line(name, value);
    if (record.start.chess960()) text += tag_line("Variant", "Chess960");
    if (record.start.position() != Position())
        text += tag_line("SetUp", "1") + tag_line("FEN", record.start.to_text());
    return text;
}

// Words one behind the other, in lines that are not too wide.
class Paragraph {
   public:
    void word(std::string_view word) {
        if (!text_.empty()) {
            blank_ = text_.size();
            text_ += ' ';
        }
        glue(std::exchange(prefix_, {}) + std::string(word));
    }
    // Stands directly before the next word.
    void open(char sign) { prefix_ += sign; }
    // Stands directly behind the last word.
    void glue(std::string_view sign) {
        text_ += sign;
        if (text_.size() - line_ <= widest || blank_ <= line_) return;
        text_[blank_] = '\n';
        line_ = blank_ + 1;
    }
    std::string take() { return std::move(text_); }

   private:
    std::string text_, prefix_;
    std::size_t line_ = 0,
                blank_ = 0;  // where the last line begins; the blank before the last word
};

class MoveWriter {
   public:
    explicit MoveWriter(const Record& record) : record_(record) {
        comment(record.nodes[0].comment);
        frames_.push_back({0, 0, record.start.position()});
    }

    std::string run() {
        while (!frames_.empty()) step();
        paragraph_.word(record_.result);
        return paragraph_.take();
    }

   private:
    // A line of moves: the node it has come to, and the next of its children to write.
    struct Frame {
        std::uint32_t node;
        std::size_t child;
        Position position;
    };

    void step();
    void move(const Position& position, const Node& node);
    void comment(std::string_view text);

    const Record& record_;
    std::vector<Frame> frames_;
    Paragraph paragraph_;
    bool number_black_ = true;  // the next move of Black's needs its number
};

void MoveWriter::step() {
    Frame& line = frames_.back();
    const auto& children = record_.nodes[line.node].children;
    if (children.empty()) {
        frames_.pop_back();
        number_black_ = true;
        if (!frames_.empty()) paragraph_.glue(")");
    } else if (line.child == children.size()) {
        line.node = children[0];
        line.child = 0;
        line.position.play(record_.nodes[line.node].move);
    } else {
        const std::uint32_t child = children[line.child++];
        const bool variation = line.child > 1;
        if (variation) paragraph_.open('(');
        number_black_ |= variation;
        move(line.position, record_.nodes[child]);
        if (!variation) return;
        Frame branch{child, 0, line.position};
        branch.position.play(record_.nodes[child].move);
        frames_.push_back(branch);
    }
}

void MoveWriter::move(const Position& position, const Node& node) {
    comment(node.comment_before);
    const int number = position.ply() / 2 + 1;
    if (position.to_play() == Player::first)
        paragraph_.word(fmt::format("{}.", number));
    else if (number_black_)
        paragraph_.word(fmt::format("{}...", number));
    paragraph_.word(san(position, node.move));
    number_black_ = false;
    for (const auto nag : node.nags) paragraph_.word(fmt::format("${}", nag));
    comment(node.comment);
}

void MoveWriter::comment(std::string_view text) {
    if (text.empty()) return;
    number_black_ = true;
    paragraph_.open('{');
    while (!text.empty()) {
        const auto end = std::min(text.find(' '), text.size());
        std::string word(text.substr(0, end));
        std::replace(word.begin(), word.end(), '{', '(');
        std::replace(word.begin(), word.end(), '}', ')');
        paragraph_.word(word);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    paragraph_.glue("}");
}

}  // namespace

std::string_view Record::tag(std::string_view name) const {
    for (const auto& tag : tags)
        if (tag.name == name) return tag.value;
    return {};
}

std::vector<Move> Record::main_line() const {
    std::vector<Move> moves;
    for (std::uint32_t node = 0; !nodes[node].children.empty();) {
        node = nodes[node].children[0];
        moves.push_back(nodes[node].move);
    }
    return moves;
}

Record record_of(const Chess& start, const std::vector<Move>& moves, std::string_view result,
                 std::vector<Tag> tags) {
    Record record{std::move(tags), start, std::vector<Node>(1), std::string(result)};
    for (const Move move : moves) {
        record.nodes.back().children.push_back(static_cast<std::uint32_t>(record.nodes.size()));
        record.nodes.emplace_back().move = move;
    }
    return record;
}

std::string to_text(const Record& record) {
    return tag_lines(record) + '\n' + MoveWriter(record).run() + "\n\n";
}

}  // namespace chess::pgn
