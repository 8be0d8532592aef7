#include "engine/shogi/csa.h"

#include "engine/base/text.h"
#include "engine/shogi/csa_words.h"

namespace shogi::csa {
namespace {

std::string digits_of(int square) {
    return {static_cast<char>('1' + file_of(square)), static_cast<char>('1' + rank_of(square))};
}

void append_hand(std::string& text, const Position& position, Player player) {
    std::string hand;
    for (const Kind kind : hand_kinds)
        for (int i = position.hand(player, kind); i > 0; --i)
            hand.append("00").append(kind_names[index(kind)]);
    if (!hand.empty()) text.append({'P', sign(player)}).append(hand) += '\n';
}

void append_position(std::string& text, const Position& position) {
    Position even = Position::start();
    even.set_to_play(position.to_play());
    if (position == even) {
        text += "PI\n";
    } else {
        for (int rank = 0; rank < board_size; ++rank) {
            text.append({'P', static_cast<char>('1' + rank)});
            for (int file = board_size - 1; file >= 0; --file) {
                const Piece piece = position.at(square_at(file, rank));
                if (piece.empty())
                    text += " * ";
                else
                    (text += sign(piece.player())) += kind_names[index(piece.kind())];
            }
            text += '\n';
        }
        append_hand(text, position, Player::first);
        append_hand(text, position, Player::second);
    }
    text.append({sign(position.to_play()), '\n'});
}

void append_comment(std::string& text, std::string_view comment) {
    while (!comment.empty()) {
        const auto end = comment.find('\n');
        text.append("'").append(comment.substr(0, end)) += '\n';
        comment.remove_prefix(end == comment.npos ? comment.size() : end + 1);
    }
}

void append_ending(std::string& text, Ending ending, Player mover) {
    if (ending == Ending::foul_of_opponent) {
        text.append({'%', sign(~mover)}).append("ILLEGAL_ACTION\n");
        return;
    }
    // CSA has no word for a player who did not come.
    if (ending == Ending::forfeit) ending = Ending::resignation;
    for (const auto& [name, named] : endings)
        if (named == ending) {
            text.append("%").append(name) += '\n';
            return;
        }
}

void append_heading(std::string& text, std::string_view mark, std::string_view value) {
    text.append(mark).append(value.substr(0, value.find('\n'))) += '\n';
}

}  // namespace

std::string to_csa(const Position& position, Move move) {
    std::string text(1, sign(position.to_play()));
    const int to = to_square(move);
    if (is_drop(move))
        return text.append("00")
            .append(digits_of(to))
            .append(kind_names[index(dropped_kind(move))]);
    const Kind kind = position.at(from_square(move)).kind();
    return text.append(digits_of(from_square(move)))
        .append(digits_of(to))
        .append(kind_names[index(is_promotion(move) ? promoted(kind) : kind)]);
}

std::optional<Move> parse_csa_move(const Position& position, std::string_view text) {
    if (text.size() != 7 || player_of(text[0]) != position.to_play()) return std::nullopt;
    const Kind after = kind_named(text.substr(5));
    const auto to = square_of(text.substr(3));
    if (after == Kind::none || !to) return std::nullopt;
    if (text.substr(1, 2) == "00")
        return after <= Kind::rook ? std::optional(drop_move(after, *to)) : std::nullopt;
    const auto from = square_of(text.substr(1));
    if (!from || *from == *to) return std::nullopt;
    const Kind before = position.at(*from).kind();
    if (before == after) return board_move(*from, *to);
    if (!can_promote(before) || promoted(before) != after) return std::nullopt;
    return board_move(*from, *to, true);
}

std::string to_text(const Record& record) {
    std::string text = "V2.2\n";
    append_heading(text, "N+", record.black);
    append_heading(text, "N-", record.white);
    for (const auto& [name, value] : record.facts)
        if (engine::is_ascii(name)) append_heading(text, "$" + name + ":", value);
    Position position = record.start.position();
    append_position(text, position);
    append_comment(text, record.nodes[0].comment);
    std::uint32_t at = 0;
    while (!record.nodes[at].children.empty()) {
        at = record.nodes[at].children[0];
        const Node& node = record.nodes[at];
        text.append(to_csa(position, node.move)) += '\n';
        if (node.seconds) text.append("T").append(std::to_string(*node.seconds)) += '\n';
        append_comment(text, node.comment);
        position.play(node.move);
    }
    append_ending(text, record.nodes[at].ending, position.to_play());
    return text;
}

}  // namespace shogi::csa
