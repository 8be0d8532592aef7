#include "engine/chess/san.h"

#include <algorithm>

#include "engine/chess/chess.h"
#include "engine/chess/fen.h"

namespace chess {

namespace {

bool is_file(char letter) { return letter >= 'a' && letter <= 'h'; }
bool is_rank(char letter) { return letter >= '1' && letter <= '8'; }

std::string check_sign(const Position& position, Move move) {
    Position next = position;
    next.play(move);
    if (!next.in_check()) return "";
    return next.has_legal_move() ? "+" : "#";
}

// What must be said of the origin to tell `move` from others of the same piece to the same square.
std::string origin_text(const Position& position, Move move) {
    const Square from = from_of(move);
    bool rivals = false, same_file = false, same_rank = false;
    for (const Move other : position.legal_moves()) {
        const Square origin = from_of(other);
        if (origin == from || to_of(other) != to_of(move) || kind_of(other) == MoveKind::castling ||
            position.piece_at(origin) != position.piece_at(from))
            continue;
        rivals = true;
        same_file |= file_of(origin) == file_of(from);
        same_rank |= rank_of(origin) == rank_of(from);
    }
    const std::string square = square_text(from);
    if (!rivals) return "";
    if (!same_file) return square.substr(0, 1);
    return same_rank ? square : square.substr(1);
}

std::string pawn_text(Move move) {
    const Square from = from_of(move), to = to_of(move);
    std::string text;
    if (file_of(from) != file_of(to)) text = {square_text(from)[0], 'x'};
    text += square_text(to);
    if (kind_of(move) == MoveKind::promotion) {
        text += '=';
        text += piece_letter(promoted_of(move));
    }
    return text;
}

std::string piece_text(const Position& position, Move move) {
    const Piece piece = position.piece_at(from_of(move));
    std::string text{piece_letter(piece)};
    if (piece != Piece::king) text += origin_text(position, move);
    if (position.has(to_of(move))) text += 'x';
    return text + square_text(to_of(move));
}

// What a text says about the move; what it leaves open is empty.
struct Described {
    Piece piece = Piece::pawn;
    std::optional<int> from_file, from_rank;
    Square to = no_square;
    std::optional<Piece> promoted;
    std::optional<bool> king_side;  // castling

    bool fits(const Position& position, Move move) const {
        const Square from = from_of(move);
        const bool castles = kind_of(move) == MoveKind::castling;
        if (castles || king_side) return castles && king_side && *king_side == (to_of(move) > from);
        if (to_of(move) != to || position.piece_at(from) != piece) return false;
        if (from_file && *from_file != file_of(from)) return false;
        if (from_rank && *from_rank != rank_of(from)) return false;
        const bool promotes = kind_of(move) == MoveKind::promotion;
        return promotes ? promoted == promoted_of(move) : !promoted;
    }
};

std::optional<bool> castling_side(std::string_view text) {
    std::string plain;
    for (const char letter : text)
        if (letter != '-') plain += letter == '0' || letter == 'o' ? 'O' : letter;
    if (plain == "OO") return true;
    if (plain == "OOO") return false;
    return std::nullopt;
}

void drop_end(std::string_view& text, std::string_view end) {
    if (text.ends_with(end)) text.remove_suffix(end.size());
}

std::string_view without_annotations(std::string_view text) {
    while (!text.empty() && std::string_view("+#!?").find(text.back()) != text.npos)
        text.remove_suffix(1);
    drop_end(text, "e.p.");
    drop_end(text, "e.p");
    drop_end(text, "ep");
    return text;
}

// "=Q", "Q", "(Q)", "/Q" at the end of a pawn's move.
std::optional<Piece> take_promotion(std::string_view& text) {
    drop_end(text, ")");
    if (text.size() < 3 || is_rank(text.back())) return std::nullopt;
    const auto piece = piece_from_letter(text.back());
    text.remove_suffix(1);
    for (const auto* sign : {"=", "(", "/"}) drop_end(text, sign);
    return piece;
}

// "b" is a file, never a bishop.
std::optional<Piece> take_piece(std::string_view& text) {
    const char letter = text.front();
    if (is_file(letter)) return Piece::pawn;
    const auto piece = piece_from_letter(letter);
    text.remove_prefix(1);
    return piece;
}

// What stands between the piece and the goal: "", "b", "1", "b1", each with x or - behind.
bool read_origin(std::string_view text, Described& described) {
    for (const char letter : text) {
        if (is_file(letter) && !described.from_file && !described.from_rank)
            described.from_file = letter - 'a';
        else if (is_rank(letter) && !described.from_rank)
            described.from_rank = letter - '1';
        else if (letter != 'x' && letter != '-' && letter != ':')
            return false;
    }
    return true;
}

std::optional<Described> describe(std::string_view text) {
    Described described;
    text = without_annotations(text);
    described.king_side = castling_side(text);
    if (described.king_side) return described;
    if (text.size() < 2) return std::nullopt;
    const auto piece = take_piece(text);
    if (!piece) return std::nullopt;
    described.piece = *piece;
    if (piece == Piece::pawn) described.promoted = take_promotion(text);
    if (text.size() < 2) return std::nullopt;
    const auto to = square_from_text(text.substr(text.size() - 2));
    if (!to || !read_origin(text.substr(0, text.size() - 2), described)) return std::nullopt;
    described.to = *to;
    return described;
}

}  // namespace

std::string san(const Position& position, Move move) {
    if (kind_of(move) == MoveKind::castling)
        return (to_of(move) > from_of(move) ? "O-O" : "O-O-O") + check_sign(position, move);
    const bool pawn = position.piece_at(from_of(move)) == Piece::pawn;
    return (pawn ? pawn_text(move) : piece_text(position, move)) + check_sign(position, move);
}

std::optional<Move> move_from_san(const Position& position, std::string_view text) {
    const auto described = describe(text);
    if (!described) return std::nullopt;
    std::optional<Move> found;
    for (const Move move : position.legal_moves()) {
        if (!described->fits(position, move)) continue;
        if (found) return std::nullopt;
        found = move;
    }
    return found;
}

std::optional<Move> move_from_san_or_uci(const Position& position, std::string_view text) {
    const auto move = move_from_san(position, text);
    return move ? move : Chess(position).move_from_text(text);
}

}  // namespace chess
