#include "engine/shogi/usi.h"

namespace shogi {
namespace {

constexpr std::string_view drop_letters = "PLNSGBR";

std::optional<int> parse_square(std::string_view text) {
    const int file = text[0] - '1', rank = text[1] - 'a';
    if (!on_board(file, rank)) return std::nullopt;
    return square_at(file, rank);
}

std::optional<Move> parse_drop(std::string_view text) {
    const auto kind = drop_letters.find(text[0]);
    const auto to = parse_square(text.substr(2));
    if (kind == std::string_view::npos || !to) return std::nullopt;
    return drop_move(hand_kinds[kind], *to);
}

}  // namespace

std::optional<Move> parse_usi_move(std::string_view text) {
    if (text.size() != 4 && (text.size() != 5 || text[4] != '+')) return std::nullopt;
    if (text[1] == '*') return text.size() == 4 ? parse_drop(text) : std::nullopt;
    const auto from = parse_square(text), to = parse_square(text.substr(2));
    if (!from || !to || *from == *to) return std::nullopt;
    return board_move(*from, *to, text.size() == 5);
}

std::string to_usi(int square) {
    return {static_cast<char>('1' + file_of(square)), static_cast<char>('a' + rank_of(square))};
}

std::string to_usi(Move move) {
    const auto to = to_usi(to_square(move));
    if (is_drop(move)) return std::string{drop_letters[index(dropped_kind(move)) - 1], '*'} + to;
    return to_usi(from_square(move)) + to + (is_promotion(move) ? "+" : "");
}

}  // namespace shogi
