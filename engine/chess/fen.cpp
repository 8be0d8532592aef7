#include "engine/chess/fen.h"

#include <charconv>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/text.h"

namespace chess {

namespace {

constexpr std::string_view letters = "PNBRQK";
constexpr std::size_t longest = 200;

char upper(char letter) {
    return engine::is_lower(letter) ? static_cast<char>(letter - 'a' + 'A') : letter;
}

std::vector<std::string_view> fields_of(std::string_view text) {
    constexpr std::string_view blanks = " \t\r\n";
    std::vector<std::string_view> fields;
    for (auto at = text.find_first_not_of(blanks); at != text.npos;
         at = text.find_first_not_of(blanks, at)) {
        const auto end = std::min(text.find_first_of(blanks, at), text.size());
        fields.push_back(text.substr(at, end - at));
        at = end;
    }
    return fields;
}

Setup::Man man_from(char letter) {
    const auto piece = piece_from_letter(letter);
    if (!piece) engine::fail("FEN: unknown piece \"{}\"", engine::excerpt({&letter, 1}));
    return {engine::is_upper(letter) ? Player::first : Player::second, *piece};
}

void read_board(std::string_view field, Setup& setup) {
    int file = 0, rank = 7;
    for (const char letter : field) {
        if (letter == '/') {
            if (file != 8) engine::fail("FEN: rank {} has {} squares, not 8", rank + 1, file);
            if (rank == 0) engine::fail("FEN: more than 8 ranks");
            --rank;
            file = 0;
        } else if (letter >= '1' && letter <= '8') {
            file += letter - '0';
        } else {
            const auto man = man_from(letter);
            if (file < 8) setup.board[index(square_at(file, rank))] = man;
            ++file;
        }
        if (file > 8) engine::fail("FEN: rank {} has more than 8 squares", rank + 1);
    }
    if (rank != 0 || file != 8) engine::fail("FEN: the board has fewer than 8 ranks of 8 squares");
}

bool is_man(const Setup& setup, Square square, Player player, Piece piece) {
    const auto& man = setup.board[index(square)];
    return man && man->player == player && man->piece == piece;
}

// The outermost rook on that side of the king.
Square outermost_rook(const Setup& setup, Player player, bool king_side) {
    const int rank = player == Player::first ? 0 : 7, step = king_side ? -1 : 1;
    for (int file = king_side ? 7 : 0; file >= 0 && file < 8; file += step) {
        const Square square = square_at(file, rank);
        if (is_man(setup, square, player, Piece::king)) break;
        if (is_man(setup, square, player, Piece::rook)) return square;
    }
    return no_square;
}

Square castling_rook_from(char letter, const Setup& setup) {
    const Player player = engine::is_upper(letter) ? Player::first : Player::second;
    const int rank = player == Player::first ? 0 : 7;
    const char side = upper(letter);
    if (side == 'K' || side == 'Q') return outermost_rook(setup, player, side == 'K');
    if (side < 'A' || side > 'H')
        engine::fail("FEN: bad castling letter \"{}\"", engine::excerpt({&letter, 1}));
    const Square square = square_at(side - 'A', rank);
    return is_man(setup, square, player, Piece::rook) ? square : no_square;
}

void read_castling(std::string_view field, Setup& setup) {
    if (field == "-") return;
    if (field.size() > 4)
        engine::fail("FEN: castling field \"{}\" is too long", engine::excerpt(field));
    for (const char letter : field) {
        const Square rook = castling_rook_from(letter, setup);
        if (rook == no_square) engine::fail("FEN: castling \"{}\" without its rook", letter);
        if (setup.castling_rooks & bit(rook)) engine::fail("FEN: castling \"{}\" twice", field);
        setup.castling_rooks |= bit(rook);
    }
}

int counter_from(std::string_view field, std::string_view name, int most) {
    int value = -1;
    const auto [end, status] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (status != std::errc{} || end != field.data() + field.size() || value < 0 || value > most)
        engine::fail("FEN: {} \"{}\" is not a number in 0..{}", name, engine::excerpt(field), most);
    return value;
}

// A letter per castling rook; K and Q where it is the outermost.
std::string castling_text(const Position& position) {
    std::string text;
    for (const Player player : {Player::first, Player::second})
        for (const bool king_side : {true, false}) {
            const auto rook = position.castling_rook(player, king_side);
            if (!rook) continue;
            const Bitboard beyond = king_side ? ~Bitboard{0} << *rook << 1 : (bit(*rook) - 1);
            const Bitboard rivals =
                position.pieces(player, Piece::rook) & rank_mask(player, 0) & beyond;
            char letter = king_side ? 'K' : 'Q';
            if (rivals != 0) letter = static_cast<char>('A' + file_of(*rook));
            text += static_cast<char>(letter + (player == Player::first ? 0 : 'a' - 'A'));
        }
    return text.empty() ? "-" : text;
}

std::string board_text(const Position& position) {
    std::string text;
    for (int rank = 7; rank >= 0; --rank) {
        int empty = 0;
        const auto write_empty = [&] {
            if (empty > 0) text += static_cast<char>('0' + empty);
            empty = 0;
        };
        for (int file = 0; file < 8; ++file) {
            const Square square = square_at(file, rank);
            if (!position.has(square)) {
                ++empty;
                continue;
            }
            write_empty();
            const char letter = piece_letter(position.piece_at(square));
            const bool white = position.player_at(square) == Player::first;
            text += static_cast<char>(white ? letter : letter - 'A' + 'a');
        }
        write_empty();
        if (rank > 0) text += '/';
    }
    return text;
}

}  // namespace

Position position_from_fen(std::string_view text) {
    if (text.size() > longest) engine::fail("FEN: longer than {} characters", longest);
    const auto fields = fields_of(text);
    if (fields.size() < 2)
        engine::fail("FEN: \"{}\" lacks the side to move", engine::excerpt(text));
    if (fields.size() > 6)
        engine::fail("FEN: unexpected \"{}\" at the end", engine::excerpt(fields[6]));
    Setup setup;
    read_board(fields[0], setup);
    if (fields[1] != "w" && fields[1] != "b")
        engine::fail("FEN: the side to move is \"{}\", not w or b", engine::excerpt(fields[1]));
    setup.to_play = fields[1] == "w" ? Player::first : Player::second;
    if (fields.size() > 2) read_castling(fields[2], setup);
    if (fields.size() > 3 && fields[3] != "-") {
        const auto square = square_from_text(fields[3]);
        if (!square) engine::fail("FEN: en passant square \"{}\"", engine::excerpt(fields[3]));
        setup.en_passant = *square;
    }
    if (fields.size() > 4) setup.halfmove_clock = counter_from(fields[4], "halfmove clock", 9999);
    const int number = fields.size() > 5 ? counter_from(fields[5], "move number", 9999) : 1;
    setup.ply = 2 * std::max(number - 1, 0) + (setup.to_play == Player::second ? 1 : 0);
    return Position(setup);
}

std::string fen_without_counters(const Position& position) {
    const auto square = position.en_passant();
    return fmt::format("{} {} {} {}", board_text(position),
                       position.to_play() == Player::first ? 'w' : 'b', castling_text(position),
                       square ? square_text(*square) : "-");
}

std::string fen(const Position& position) {
    return fmt::format("{} {} {}", fen_without_counters(position), position.halfmove_clock(),
                       position.ply() / 2 + 1);
}

std::optional<Square> square_from_text(std::string_view text) {
    if (text.size() != 2 || text[0] < 'a' || text[0] > 'h' || text[1] < '1' || text[1] > '8')
        return std::nullopt;
    return square_at(text[0] - 'a', text[1] - '1');
}

std::string square_text(Square square) {
    return {static_cast<char>('a' + file_of(square)), static_cast<char>('1' + rank_of(square))};
}

char piece_letter(Piece piece) { return letters[index(piece)]; }

std::optional<Piece> piece_from_letter(char letter) {
    const auto at = letters.find(upper(letter));
    if (at == letters.npos) return std::nullopt;
    return static_cast<Piece>(at);
}

}  // namespace chess
