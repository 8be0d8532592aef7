#include "engine/shogi/kif_move.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "engine/shogi/kif_words.h"
#include "engine/shogi/movegen.h"

namespace shogi::kif {
namespace {

std::optional<int> take_destination(Scanner& scanner, Move before) {
    if (scanner.take("同")) {
        scanner.skip_blanks();
        return before == Move{} ? std::nullopt : std::optional(to_square(before));
    }
    const auto file = scanner.take_digit();
    const auto rank = file ? scanner.take_digit() : std::nullopt;
    if (!rank) return std::nullopt;
    return square_at(*file - 1, *rank - 1);
}

// "(77)"
std::optional<int> take_origin(Scanner& scanner) {
    if (!scanner.take("(") && !scanner.take("（")) return std::nullopt;
    const auto file = scanner.take_digit();
    const auto rank = file ? scanner.take_digit() : std::nullopt;
    if (!rank || (!scanner.take(")") && !scanner.take("）"))) return std::nullopt;
    return square_at(*file - 1, *rank - 1);
}

// How KI2 tells pieces apart that reach the same square.
struct Manner {
    bool right = false, left = false, straight = false, forward = false, sideways = false,
         backward = false;
    bool any() const { return right || left || straight || forward || sideways || backward; }
};

Manner take_manner(Scanner& scanner) {
    Manner manner;
    for (bool taken = true; taken;) {
        const auto take = [&](std::string_view word, bool& flag) {
            const bool here = scanner.take(word);
            flag |= here;
            return here;
        };
        taken = take("右", manner.right) || take("左", manner.left) ||
                take("直", manner.straight) || take("上", manner.forward) ||
                take("行", manner.forward) || take("入", manner.forward) ||
                take("寄", manner.sideways) || take("引", manner.backward);
    }
    return manner;
}

enum class Promotion { unsaid, yes, no };

Promotion take_promotion(Scanner& scanner) {
    if (scanner.take("不成") || scanner.take("生")) return Promotion::no;
    return scanner.take("成") ? Promotion::yes : Promotion::unsaid;
}

// Squares seen by the mover: ranks grow ahead of it, files to its left.
int ahead(int square, Player mover) {
    return mover == Player::first ? -rank_of(square) : rank_of(square);
}
int leftwards(int square, Player mover) {
    return mover == Player::first ? file_of(square) : -file_of(square);
}

bool fits(Move move, const Manner& manner, Player mover) {
    const int from = from_square(move), to = to_square(move);
    const int gain = ahead(to, mover) - ahead(from, mover);
    if (manner.straight && (gain <= 0 || file_of(from) != file_of(to))) return false;
    if (manner.forward && gain <= 0) return false;
    if (manner.sideways && gain != 0) return false;
    return !manner.backward || gain < 0;
}

// Leaves the piece furthest to the side named, if one is.
void keep_outermost(std::vector<Move>& moves, const Manner& manner, Player mover) {
    if (moves.empty() || (!manner.right && !manner.left)) return;
    const auto place = [&](Move move) {
        const int left = leftwards(from_square(move), mover);
        return manner.left ? left : -left;
    };
    int furthest = place(moves[0]);
    for (const Move move : moves) furthest = std::max(furthest, place(move));
    std::erase_if(moves, [&](Move move) { return place(move) != furthest; });
}

// Moves of pieces of the kind on the board; where none can go there, drops.
std::vector<Move> candidates(const Position& position, Kind kind, int to, bool promotes) {
    std::vector<Move> moves;
    for (const Move move : legal_moves(position))
        if (to_square(move) == to && !is_drop(move) && is_promotion(move) == promotes &&
            position.at(from_square(move)).kind() == kind)
            moves.push_back(move);
    return moves;
}

std::optional<Move> by_manner(const Position& position, Kind kind, int to, bool promotes,
                              const Manner& manner) {
    const Player mover = position.to_play();
    auto moves = candidates(position, kind, to, promotes);
    if (moves.empty() && !manner.any() && !promotes && kind < Kind::king)
        return drop_move(kind, to);
    std::erase_if(moves, [&](Move move) { return !fits(move, manner, mover); });
    keep_outermost(moves, manner, mover);
    return moves.size() == 1 ? std::optional(moves[0]) : std::nullopt;
}

}  // namespace

bool Scanner::take(std::string_view word) {
    if (!text_.starts_with(word)) return false;
    text_.remove_prefix(word.size());
    return true;
}

void Scanner::skip_blanks() {
    while (take(" ") || take("\t") || take("　")) continue;
}

std::optional<int> Scanner::take_digit() {
    for (std::size_t digit = 1; digit <= 9; ++digit) {
        const char ascii = static_cast<char>('0' + digit);
        if (take(wide_digits[digit]) || take(kanji_digits[digit]) || take({&ascii, 1}))
            return static_cast<int>(digit);
    }
    return std::nullopt;
}

std::optional<Kind> Scanner::take_kind() {
    for (const auto& [name, kind] : kinds)
        if (take(name)) return kind;
    return std::nullopt;
}

std::optional<Move> take_move(Scanner& scanner, const Position& position, Move before) {
    const auto to = take_destination(scanner, before);
    const auto kind = to ? scanner.take_kind() : std::nullopt;
    if (!kind) return std::nullopt;
    const auto manner = take_manner(scanner);
    const auto promotion = take_promotion(scanner);
    if (scanner.take("打"))
        return *kind < Kind::king ? std::optional(drop_move(*kind, *to)) : std::nullopt;
    const bool promotes = promotion == Promotion::yes;
    const auto from = take_origin(scanner);
    if (!from) return by_manner(position, *kind, *to, promotes, manner);
    if (position.at(*from) != Piece(position.to_play(), *kind)) return std::nullopt;
    return board_move(*from, *to, promotes);
}

}  // namespace shogi::kif
