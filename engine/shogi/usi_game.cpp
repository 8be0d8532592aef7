#include "engine/shogi/usi_game.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/shogi/usi.h"

namespace shogi {
namespace {

constexpr std::string_view blanks = " \t\r\n";

// The next word; takes it off `rest`. Empty at the end.
std::string_view take_word(std::string_view& rest) {
    rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
    const auto word = rest.substr(0, rest.find_first_of(blanks));
    rest.remove_prefix(word.size());
    return word;
}

// Takes the word off `rest` if it comes next.
bool skip_word(std::string_view& rest, std::string_view wanted) {
    auto behind = rest;
    if (take_word(behind) != wanted) return false;
    rest = behind;
    return true;
}

}  // namespace

Record parse_usi_game(std::string_view line) {
    skip_word(line, "position");
    skip_word(line, "sfen");
    const auto end = std::min(line.find("moves"), line.size());
    Record record;
    record.start = Shogi::from_text(line.substr(0, end));
    line.remove_prefix(end);
    skip_word(line, "moves");
    RecordWriter writer(record);
    for (auto word = take_word(line); !word.empty(); word = take_word(line)) {
        const auto move = parse_usi_move(word);
        if (!move) engine::fail("move {} ({}) is none", writer.number(), engine::excerpt(word));
        writer.play(*move, word);
    }
    return record;
}

std::string to_usi_game(const Record& record) {
    std::string text = record.start == Shogi() ? "startpos" : "sfen " + record.start.to_text();
    const auto moves = record.main_line();
    if (!moves.empty()) text += " moves";
    for (const Move move : moves) text.append(" ").append(to_usi(move));
    return text;
}

}  // namespace shogi
