#include "engine/chess/position.h"

#include "engine/base/error.h"
#include "engine/chess/keys.h"

namespace chess {

namespace {

constexpr std::array<Piece, 8> back_rank = {Piece::rook, Piece::knight, Piece::bishop, Piece::queen,
                                            Piece::king, Piece::bishop, Piece::knight, Piece::rook};

Setup starting_setup() {
    Setup setup;
    for (int file = 0; file < 8; ++file) {
        const Piece piece = back_rank[index(file)];
        setup.board[index(square_at(file, 0))] = {Player::first, piece};
        setup.board[index(square_at(file, 1))] = {Player::first, Piece::pawn};
        setup.board[index(square_at(file, 6))] = {Player::second, Piece::pawn};
        setup.board[index(square_at(file, 7))] = {Player::second, piece};
    }
    setup.castling_rooks = bit(0) | bit(7) | bit(56) | bit(63);
    return setup;
}

const char* name(Player player) { return player == Player::first ? "White" : "Black"; }

constexpr std::uint64_t piece_key(Player player, Piece piece, Square square) {
    return keys::table.pieces[index(player)][index(piece)][index(square)];
}

}  // namespace

Position::Position() : Position(starting_setup()) {}

Position::Position(const Setup& setup)
    : ply_(static_cast<std::uint32_t>(setup.ply)),
      halfmove_clock_(static_cast<std::uint16_t>(setup.halfmove_clock)),
      to_play_(setup.to_play) {
    board_.fill(nothing);
    for (Square square = 0; square < 64; ++square)
        if (const auto& man = setup.board[index(square)]) put(man->player, man->piece, square);
    if (to_play_ == Player::second) key_ ^= keys::table.second_to_play;
    castling_rooks_ = setup.castling_rooks;
    for (Bitboard rooks = castling_rooks_; rooks != 0;)
        key_ ^= keys::table.castling[index(pop(rooks))];
    check_setup(setup);
    check_castling();
    offer_en_passant(setup.en_passant);
}

void Position::check_setup(const Setup& setup) const {
    for (const Player player : {Player::first, Player::second}) {
        const int kings = std::popcount(pieces(player, Piece::king));
        if (kings != 1) engine::fail("{} has {} kings", name(player), kings);
        if (std::popcount(pieces(player)) > 16)
            engine::fail("{} has more than 16 pieces", name(player));
        if (std::popcount(pieces(player, Piece::pawn)) > 8)
            engine::fail("{} has more than 8 pawns", name(player));
    }
    if (pieces(Piece::pawn) & (rank_mask(0) | rank_mask(7)))
        engine::fail("there is a pawn on the first or last rank");
    if (attackers(to_play_, king(~to_play_), occupied()))
        engine::fail("{} is in check, but it is {}'s move", name(~to_play_), name(to_play_));
    if (setup.halfmove_clock < 0 || setup.halfmove_clock > 9999)
        engine::fail("the halfmove clock {} is not in 0..9999", setup.halfmove_clock);
    if (setup.ply < 0 || setup.ply > 2 * 9999)
        engine::fail("the move number {} is not in 1..9999", setup.ply / 2 + 1);
}

void Position::check_castling() const {
    for (const Player player : {Player::first, Player::second}) {
        const Bitboard rank = rank_mask(player, 0), rooks = castling_rooks_ & rank;
        if (rooks & ~pieces(player, Piece::rook))
            engine::fail("{} may castle, but its rook is not there", name(player));
        if (rooks == 0) continue;
        if (!(pieces(player, Piece::king) & rank))
            engine::fail("{} may castle, but its king has left its rank", name(player));
        const Bitboard right = ~Bitboard{0} << king(player);
        if (more_than_one(rooks & right) || more_than_one(rooks & ~right))
            engine::fail("{} may castle with two rooks on the same side", name(player));
    }
    if (castling_rooks_ & ~(rank_mask(0) | rank_mask(7)))
        engine::fail("a castling rook is not on its back rank");
}

std::optional<Square> Position::castling_rook(Player player, bool king_side) const {
    const Bitboard rooks = castling_rooks_ & rank_mask(player, 0);
    const Bitboard right = ~Bitboard{0} << king(player);
    const Bitboard rook = king_side ? rooks & right : rooks & ~right;
    if (rook == 0) return std::nullopt;
    return first_square(rook);
}

std::optional<Square> Position::en_passant() const {
    if (en_passant_ == no_square) return std::nullopt;
    return en_passant_;
}

Bitboard Position::attackers(Player by, Square square, Bitboard taken) const {
    const Bitboard queens = pieces(Piece::queen);
    const Bitboard all = (pawn_attacks(~by, square) & pieces(Piece::pawn)) |
                         (knight_attacks(square) & pieces(Piece::knight)) |
                         (king_attacks(square) & pieces(Piece::king)) |
                         (bishop_attacks(square, taken) & (pieces(Piece::bishop) | queens)) |
                         (rook_attacks(square, taken) & (pieces(Piece::rook) | queens));
    return all & pieces(by);
}

Bitboard Position::checkers() const { return attackers(~to_play_, king(to_play_), occupied()); }

bool Position::insufficient_material() const {
    if (pieces(Piece::pawn) | pieces(Piece::rook) | pieces(Piece::queen)) return false;
    const Bitboard bishops = pieces(Piece::bishop), knights = pieces(Piece::knight);
    if (knights != 0) return bishops == 0 && !more_than_one(knights);
    return !(bishops & dark_squares) || !(bishops & ~dark_squares);
}

void Position::put(Player player, Piece piece, Square square) {
    kinds_[index(piece)] |= bit(square);
    players_[index(player)] |= bit(square);
    board_[index(square)] = static_cast<std::uint8_t>(piece);
    key_ ^= piece_key(player, piece, square);
}

void Position::remove(Player player, Piece piece, Square square) {
    kinds_[index(piece)] ^= bit(square);
    players_[index(player)] ^= bit(square);
    board_[index(square)] = nothing;
    key_ ^= piece_key(player, piece, square);
}

void Position::shift_piece(Player player, Piece piece, Square from, Square to) {
    const Bitboard both = bit(from) | bit(to);
    kinds_[index(piece)] ^= both;
    players_[index(player)] ^= both;
    board_[index(from)] = nothing;
    board_[index(to)] = static_cast<std::uint8_t>(piece);
    key_ ^= piece_key(player, piece, from) ^ piece_key(player, piece, to);
}

void Position::lose_castling(Bitboard rooks) {
    castling_rooks_ ^= rooks;
    while (rooks != 0) key_ ^= keys::table.castling[index(pop(rooks))];
}

bool Position::en_passant_legal(Square from, Square to) const {
    const Bitboard captured = bit(to ^ 8);
    const Bitboard after = (occupied() ^ bit(from) ^ captured) | bit(to);
    return (attackers(~to_play_, king(to_play_), after) & ~captured) == 0;
}

// `square` is passed by a pawn of the player who has just moved.
void Position::offer_en_passant(Square square) {
    if (square == no_square || rank_of(square) != (to_play_ == Player::first ? 5 : 2)) return;
    const Bitboard passed = bit(square ^ 8),
                   origin = bit(square + (to_play_ == Player::first ? 8 : -8));
    if (!(pieces(~to_play_, Piece::pawn) & passed) || (occupied() & (bit(square) | origin))) return;
    for (Bitboard takers = pawn_attacks(~to_play_, square) & pieces(to_play_, Piece::pawn);
         takers != 0;)
        if (en_passant_legal(pop(takers), square)) {
            en_passant_ = static_cast<std::uint8_t>(square);
            key_ ^= keys::table.en_passant[index(file_of(square))];
            return;
        }
}

void Position::play(Move move) {
    if (to_play_ == Player::first)
        play_as<Player::first>(move);
    else
        play_as<Player::second>(move);
}

template <Player us>
void Position::play_as(Move move) {
    const Square from = from_of(move), to = to_of(move);
    const MoveKind kind = kind_of(move);
    const auto piece = static_cast<Piece>(board_[index(from)]);
    if (en_passant_ != no_square) {
        key_ ^= keys::table.en_passant[index(file_of(en_passant_))];
        en_passant_ = no_square;
    }
    ++ply_;
    ++halfmove_clock_;
    Bitboard lost = castling_rooks_ & (bit(from) | bit(to));
    if (piece == Piece::king) lost |= castling_rooks_ & rank_mask(us, 0);
    if (lost != 0) lose_castling(lost);
    if (kind == MoveKind::castling) {
        castle<us>(from, to);
    } else {
        if (board_[index(to)] != nothing) {
            remove(~us, static_cast<Piece>(board_[index(to)]), to);
            halfmove_clock_ = 0;
        }
        shift_piece(us, piece, from, to);
    }
    to_play_ = ~us;
    key_ ^= keys::table.second_to_play;
    if (piece == Piece::pawn) finish_pawn_move<us>(move);
}

template <Player us>
void Position::castle(Square king_from, Square rook_from) {
    const int rank = rank_of(king_from);
    const bool king_side = rook_from > king_from;
    // Either may land where the other stood.
    remove(us, Piece::king, king_from);
    remove(us, Piece::rook, rook_from);
    put(us, Piece::king, square_at(king_side ? 6 : 2, rank));
    put(us, Piece::rook, square_at(king_side ? 5 : 3, rank));
}

template <Player us>
void Position::finish_pawn_move(Move move) {
    const Square from = from_of(move), to = to_of(move);
    halfmove_clock_ = 0;
    if (kind_of(move) == MoveKind::en_passant) {
        remove(~us, Piece::pawn, to ^ 8);
    } else if (kind_of(move) == MoveKind::promotion) {
        remove(us, Piece::pawn, to);
        put(us, promoted_of(move), to);
    } else if ((from ^ to) == 16) {
        const Square passed = (from + to) / 2;
        if (pawn_attacks(us, passed) & pieces(~us, Piece::pawn)) offer_en_passant(passed);
    }
}

}  // namespace chess
