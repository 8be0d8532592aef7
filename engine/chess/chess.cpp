#include "engine/chess/chess.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/chess/fen.h"

namespace chess {

namespace {

// Without a capture or a pawn's move: 50 moves of each side.
constexpr int most_quiet_plies = 100;

constexpr Bitboard king_home = bit(4) | bit(60), rooks_home = bit(0) | bit(7) | bit(56) | bit(63);

// Castling rights that ordinary chess has no words for.
bool needs_chess960(const Position& position) {
    if (position.castling_rooks() & ~rooks_home) return true;
    for (const Player player : {Player::first, Player::second}) {
        const bool may_castle = position.castling_rooks() & rank_mask(player, 0);
        if (may_castle && !(position.pieces(player, Piece::king) & king_home)) return true;
    }
    return false;
}

Square castled_king(Square king, Square rook) {
    return square_at(rook > king ? 6 : 2, rank_of(king));
}

// The legal move by `from`, `to` and the promotion, castling in either notation.
bool means(Move move, Square from, Square to, std::optional<Piece> promoted) {
    if (from_of(move) != from) return false;
    const bool promotes = kind_of(move) == MoveKind::promotion;
    if (promotes != promoted.has_value() || (promotes && promoted_of(move) != *promoted))
        return false;
    return to_of(move) == to;
}

}  // namespace

PackedBoard::PackedBoard(const Position& position) : white_(position.pieces(Player::first)) {
    for (std::size_t plane = 0; plane < bits_.size(); ++plane)
        for (int kind = 0; kind < piece_kinds; ++kind)
            if ((kind + 1) >> plane & 1) bits_[plane] |= position.pieces(static_cast<Piece>(kind));
}

Bitboard PackedBoard::pieces(Player player, Piece piece) const {
    Bitboard set = player == Player::first ? white_ : ~white_;
    for (std::size_t plane = 0; plane < bits_.size(); ++plane)
        set &= (index(piece) + 1) >> plane & 1 ? bits_[plane] : ~bits_[plane];
    return set;
}

Chess::Chess(const Position& position) : position_(position), chess960_(needs_chess960(position)) {}

Ending Chess::ending() const {
    if (!position_.has_legal_move())
        return position_.in_check() ? Ending::checkmate : Ending::stalemate;
    if (position_.insufficient_material()) return Ending::insufficient_material;
    if (repetitions_ >= 2) return Ending::threefold_repetition;
    if (position_.halfmove_clock() >= most_quiet_plies) return Ending::fifty_moves;
    return Ending::none;
}

Ending Chess::forced_ending() const {
    const Ending ending = this->ending();
    if (ending != Ending::threefold_repetition && ending != Ending::fifty_moves) return ending;
    if (repetitions_ >= 4) return Ending::fivefold_repetition;
    if (position_.halfmove_clock() >= 150) return Ending::seventy_five_moves;
    return Ending::none;
}

Outcome Chess::outcome() const {
    switch (ending()) {
        case Ending::none:
            return Outcome::ongoing;
        case Ending::checkmate:
            return engine::win_for(~to_play());
        default:
            return Outcome::draw;
    }
}

std::optional<engine::ForcedMate> Chess::forced_mate() const {
    const auto mate = engine::find_forced_mate(position_);
    const bool in_time = !mate || position_.halfmove_clock() + mate->plies <= most_quiet_plies;
    return in_time ? mate : std::nullopt;
}

void Chess::play(Move move) {
    const auto slot = static_cast<std::size_t>(position_.ply()) % past_.size();
    past_[slot] = PackedBoard(position_);
    past_repetitions_[slot] = static_cast<std::uint8_t>(std::min(repetitions_, 255));
    remembered_ =
        static_cast<std::uint8_t>(std::min(remembered_ + 1, static_cast<int>(past_.size())));
    keys_.push_back(position_.key());
    position_.play(move);
    if (position_.halfmove_clock() == 0) keys_.clear();
    repetitions_ = static_cast<int>(std::count(keys_.begin(), keys_.end(), position_.key()));
}

std::optional<Chess::PastBoard> Chess::board_before(int ago) const {
    if (ago == 0) return PastBoard{PackedBoard(position_), repetitions_};
    if (ago > remembered_) return std::nullopt;
    const auto slot = static_cast<std::size_t>(position_.ply() - ago) % past_.size();
    return PastBoard{past_[slot], past_repetitions_[slot]};
}

Chess Chess::from_text(std::string_view text) {
    return text == "startpos" ? Chess() : Chess(position_from_fen(text));
}

std::string Chess::to_text() const { return fen(position_); }

std::optional<Move> Chess::move_from_text(std::string_view text) const {
    if (text.size() != 4 && text.size() != 5) return std::nullopt;
    const auto from = square_from_text(text.substr(0, 2)), to = square_from_text(text.substr(2, 2));
    if (!from || !to) return std::nullopt;
    std::optional<Piece> promoted;
    if (text.size() == 5 && !(promoted = piece_from_letter(text[4]))) return std::nullopt;
    const auto legal = legal_moves();
    for (const Move move : legal)
        if (means(move, *from, *to, promoted)) return move;
    // A king's leap of two files or more can only be castling by the king's goal.
    const bool leap = std::abs(file_of(*from) - file_of(*to)) > 1;
    for (const Move move : legal)
        if (leap && !promoted && kind_of(move) == MoveKind::castling && from_of(move) == *from &&
            castled_king(*from, to_of(move)) == *to)
            return move;
    return std::nullopt;
}

std::string Chess::move_to_text(Move move) const {
    const bool castling = kind_of(move) == MoveKind::castling;
    const Square from = from_of(move);
    const Square to = castling && !chess960_ ? castled_king(from, to_of(move)) : to_of(move);
    std::string text = square_text(from) + square_text(to);
    if (kind_of(move) == MoveKind::promotion)
        text += static_cast<char>(piece_letter(promoted_of(move)) - 'A' + 'a');
    return text;
}

std::string_view text(Ending ending) {
    constexpr std::array<std::string_view, 8> texts = {"none",
                                                       "checkmate",
                                                       "stalemate",
                                                       "3-fold repetition",
                                                       "50 moves",
                                                       "insufficient material",
                                                       "5-fold repetition",
                                                       "75 moves"};
    return texts[static_cast<std::size_t>(ending)];
}

}  // namespace chess
