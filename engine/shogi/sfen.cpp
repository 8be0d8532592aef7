#include "engine/shogi/sfen.h"

#include <array>
#include <charconv>
#include <optional>
#include <vector>

#include "engine/base/error.h"

namespace shogi {
namespace {

using engine::fail;

constexpr std::string_view kind_letters = " PLNSGBRK";
constexpr std::size_t longest = 256;
constexpr int most_moves = 1'000'000;

// The unpromoted piece that a letter stands for.
std::optional<Piece> piece_of(char letter) {
    const bool small = letter >= 'a' && letter <= 'z';
    const auto kind = kind_letters.find(small ? static_cast<char>(letter - 'a' + 'A') : letter);
    if (kind == std::string_view::npos || kind == 0) return std::nullopt;
    return Piece(small ? Player::second : Player::first, static_cast<Kind>(kind));
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    while (true) {
        const auto end = text.find(separator);
        parts.push_back(text.substr(0, end));
        if (end == std::string_view::npos) return parts;
        text.remove_prefix(end + 1);
    }
}

std::vector<std::string_view> fields(std::string_view text) {
    auto parts = split(text, ' ');
    std::erase_if(parts, [](std::string_view part) { return part.empty(); });
    return parts;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// One rank of the board, from file 9 to file 1.
void parse_rank(Position& position, std::string_view text, int rank) {
    int file = board_size;
    bool plus = false;
    for (const char c : text) {
        if (c == '+' && !plus) {
            plus = true;
            continue;
        }
        if (c >= '1' && c <= '9' && !plus) {
            file -= c - '0';
            continue;
        }
        const auto piece = piece_of(c);
        if (!piece) fail("SFEN: '{}' is no piece (rank {})", c, rank + 1);
        if (plus && !can_promote(piece->kind())) fail("SFEN: {} does not promote", c);
        if (--file < 0) break;
        position.put(square_at(file, rank),
                     {piece->player(), plus ? promoted(piece->kind()) : piece->kind()});
        plus = false;
    }
    if (file != 0 || plus) fail("SFEN: rank {} is not 9 squares wide: {}", rank + 1, text);
}

void parse_board(Position& position, std::string_view text) {
    const auto ranks = split(text, '/');
    if (ranks.size() != board_size) fail("SFEN: the board has {} ranks, not 9", ranks.size());
    for (int rank = 0; rank < board_size; ++rank)
        parse_rank(position, ranks[static_cast<std::size_t>(rank)], rank);
}

// Digits at the front of `text`, taken off it; 1 where there are none.
int take_number(std::string_view& text) {
    int number = 1;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (status == std::errc::result_out_of_range || number < 1 || number > 18)
        fail("SFEN: no such number of pieces in hand: {}", text);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return number;
}

void parse_hands(Position& position, std::string_view text) {
    if (text == "-") return;
    const auto all = text;
    while (!text.empty()) {
        if (!is_digit(text[0]) && !piece_of(text[0]))
            fail("SFEN: '{}' is no piece in hand", text[0]);
        const int number = take_number(text);
        const auto piece = text.empty() ? std::nullopt : piece_of(text[0]);
        if (!piece || piece->kind() == Kind::king) fail("SFEN: bad hands: {}", all);
        if (position.hand(piece->player(), piece->kind()) != 0)
            fail("SFEN: {} twice in the hands {}", text[0], all);
        position.set_hand(piece->player(), piece->kind(), number);
        text.remove_prefix(1);
    }
}

int parse_move_number(std::string_view text) {
    int number = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (status != std::errc{} || end != text.data() + text.size() || number < 0 ||
        number > most_moves)
        fail("SFEN: no move number: {}", text);
    return number < 1 ? 1 : number;
}

void check_totals(const Position& position) {
    for (std::size_t kind = 1; kind < full_set.size(); ++kind) {
        const Kind plain = static_cast<Kind>(kind);
        Bitboard on_board = position.of(plain);
        if (can_promote(plain)) on_board |= position.of(promoted(plain));
        int total = count(on_board);
        if (plain != Kind::king)
            total += position.hand(Player::first, plain) + position.hand(Player::second, plain);
        if (total > full_set[kind])
            fail("{} pieces {}, a set has {}", total, kind_letters[kind], full_set[kind]);
    }
}

void check_kings(const Position& position) {
    for (const Player player : {Player::first, Player::second})
        if (count(position.of(player, Kind::king)) > 1)
            fail("{} has two kings", player == Player::first ? "Black" : "White");
    if (position.of(Kind::king) == 0) fail("there is no king");
}

void check_pawns_and_dead_ends(const Position& position, Player player) {
    const auto* who = player == Player::first ? "Black" : "White";
    const Bitboard pawns = position.of(player, Kind::pawn);
    for (int file = 0; file < board_size; ++file)
        if (std::popcount(low(pawns >> (file * board_size)) & 511) > 1)
            fail("{} has two pawns on file {}", who, file + 1);
    const Bitboard last = far_rank(player, 0), last_two = last | far_rank(player, 1);
    if ((pawns & last) != 0) fail("{} has a pawn on the last rank", who);
    if ((position.of(player, Kind::lance) & last) != 0)
        fail("{} has a lance on the last rank", who);
    if ((position.of(player, Kind::knight) & last_two) != 0)
        fail("{} has a knight on the last two ranks", who);
}

void append_hand(std::string& text, const Position& position, Player player) {
    constexpr std::array order{Kind::rook,   Kind::bishop, Kind::gold, Kind::silver,
                               Kind::knight, Kind::lance,  Kind::pawn};
    for (const Kind kind : order) {
        const int pieces = position.hand(player, kind);
        if (pieces > 1) text += std::to_string(pieces);
        if (pieces > 0) text += letters({player, kind});
    }
}

void append_rank(std::string& text, const Position& position, int rank) {
    int empty = 0;
    const auto flush = [&] {
        if (empty > 0) text += static_cast<char>('0' + empty);
        empty = 0;
    };
    for (int file = board_size - 1; file >= 0; --file) {
        const Piece piece = position.at(square_at(file, rank));
        if (piece.empty()) {
            ++empty;
            continue;
        }
        flush();
        text += letters(piece);
    }
    flush();
}

}  // namespace

std::string letters(Piece piece) {
    if (piece.empty()) return {};
    const char letter = kind_letters[index(unpromoted(piece.kind()))];
    std::string text = is_promoted(piece.kind()) ? "+" : "";
    return text += piece.player() == Player::first ? letter : static_cast<char>(letter - 'A' + 'a');
}

void check(const Position& position) {
    check_kings(position);
    check_totals(position);
    check_pawns_and_dead_ends(position, Player::first);
    check_pawns_and_dead_ends(position, Player::second);
    Position other = position;
    other.set_to_play(~position.to_play());
    if (other.in_check())
        fail("{} is in check, but it is the other's turn",
             other.to_play() == Player::first ? "Black" : "White");
}

Sfen parse_sfen(std::string_view text) {
    if (text.size() > longest) fail("SFEN: longer than {} characters", longest);
    const auto parts = fields(text);
    if (parts.size() == 1 && parts[0] == "startpos") return {Position::start(), 1};
    if (parts.size() < 3 || parts.size() > 4)
        fail("SFEN: board, mover, hands and move number are wanted, not \"{}\"", text);
    Sfen sfen;
    parse_board(sfen.position, parts[0]);
    if (parts[1] != "b" && parts[1] != "w") fail("SFEN: the mover is b or w, not {}", parts[1]);
    sfen.position.set_to_play(parts[1] == "b" ? Player::first : Player::second);
    parse_hands(sfen.position, parts[2]);
    if (parts.size() == 4) sfen.next_move = parse_move_number(parts[3]);
    check(sfen.position);
    return sfen;
}

std::string to_sfen(const Position& position, int next_move) {
    std::string text;
    for (int rank = 0; rank < board_size; ++rank) {
        if (rank > 0) text += '/';
        append_rank(text, position, rank);
    }
    text += position.to_play() == Player::first ? " b " : " w ";
    const auto hands = text.size();
    append_hand(text, position, Player::first);
    append_hand(text, position, Player::second);
    if (text.size() == hands) text += '-';
    return text + ' ' + std::to_string(next_move);
}

}  // namespace shogi
