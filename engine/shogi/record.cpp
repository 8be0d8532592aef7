#include "engine/shogi/record.h"

#include <algorithm>

#include "engine/base/charset.h"
#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/shogi/movegen.h"
#include "engine/shogi/usi.h"

namespace shogi {
namespace {

// Of a line that stops at `game`.
Outcome outcome_of(Ending ending, const Shogi& game) {
    switch (ending) {
        case Ending::resignation:
        case Ending::mate:
        case Ending::time_up:
        case Ending::foul:
        case Ending::forfeit:
            return engine::win_for(~game.to_play());
        case Ending::declaration:
        case Ending::foul_of_opponent:
            return engine::win_for(game.to_play());
        case Ending::impasse:
        case Ending::draw:
        case Ending::move_limit:
            return Outcome::draw;
        // A perpetual check is written down as a repetition too.
        case Ending::repetition:
            return game.outcome() == Outcome::ongoing ? Outcome::draw : game.outcome();
        default:
            return game.outcome();
    }
}

// Whether all bytes beyond ASCII come in pairs of EUC-JP.
bool is_euc_jp(std::string_view bytes) {
    const auto in_pairs = [](char c) { return static_cast<unsigned char>(c) >= 0xA1; };
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (engine::is_ascii(bytes.substr(i, 1))) continue;
        if (!in_pairs(bytes[i]) || i + 1 == bytes.size() || !in_pairs(bytes[i + 1])) return false;
        ++i;
    }
    return true;
}

}  // namespace

std::vector<Move> Record::main_line() const {
    std::vector<Move> moves;
    for (std::uint32_t at = 0; !nodes[at].children.empty();) {
        at = nodes[at].children[0];
        moves.push_back(nodes[at].move);
    }
    return moves;
}

Ending Record::ending() const {
    std::uint32_t at = 0;
    while (!nodes[at].children.empty()) at = nodes[at].children[0];
    return nodes[at].ending;
}

Outcome Record::outcome() const {
    Shogi game = start;
    for (const Move move : main_line()) game.play(move);
    return outcome_of(ending(), game);
}

Record record_of(const Shogi& start, const std::vector<Move>& moves, Ending ending) {
    Record record;
    record.start = start;
    RecordWriter writer(record);
    for (const Move move : moves) writer.play(move, to_usi(move));
    writer.node().ending = ending;
    return record;
}

void RecordWriter::play(Move move, std::string_view text) {
    if (!legal_moves(position_).contains(move))
        engine::fail("move {} ({}) is illegal", number(), text);
    if (number() > most_record_moves) engine::fail("more than {} moves", most_record_moves);
    for (const auto child : node().children)
        if (record_.nodes[child].move == move) return step_to(child);
    const auto added = static_cast<std::uint32_t>(record_.nodes.size());
    node().children.push_back(added);
    record_.nodes.emplace_back().move = move;
    step_to(added);
}

void RecordWriter::go_back_to(int move_number) {
    const int back_to = move_number > number() ? 1 : std::max(move_number, 1);
    while (number() > back_to) step_back();
    while (number() < move_number && !node().children.empty()) step_to(node().children[0]);
    if (number() != move_number)
        engine::fail("a variation of move {}, which no line has", move_number);
}

void RecordWriter::step_to(std::uint32_t child) {
    const Move move = record_.nodes[child].move;
    captured_.push_back(position_.at(to_square(move)));
    position_.play(move);
    path_.push_back(child);
}

void RecordWriter::step_back() {
    position_.take_back(node().move, captured_.back());
    captured_.pop_back();
    path_.pop_back();
}

std::string japanese_text(std::string_view bytes) {
    if (bytes.substr(0, 3) == "\xEF\xBB\xBF") bytes.remove_prefix(3);
    if (engine::is_utf8(bytes)) return std::string(bytes);
    return engine::to_utf8(bytes, is_euc_jp(bytes) ? "EUC-JP" : "Shift_JIS");
}

}  // namespace shogi
