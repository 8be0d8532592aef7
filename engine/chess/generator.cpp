// Legal moves of a position, one colour at compile time. What is done with them (listed, counted,
// noticed) is a sink's business, so that perft counts sets of targets without making moves.
#include "engine/chess/position.h"

namespace chess {

namespace {

constexpr std::array<Piece, 4> promotions = {Piece::queen, Piece::rook, Piece::bishop,
                                             Piece::knight};

class ListSink {
   public:
    explicit ListSink(MoveList& list) : list_(list) {}
    void from(Square from, Bitboard targets) {
        while (targets != 0) list_.push(make_move(from, pop(targets)));
    }
    void pawns(int step, Bitboard targets) {
        while (targets != 0) {
            const Square to = pop(targets);
            list_.push(make_move(to - step, to));
        }
    }
    void promoting(int step, Bitboard targets) {
        while (targets != 0) {
            const Square to = pop(targets);
            for (const Piece piece : promotions)
                list_.push(make_move(to - step, to, MoveKind::promotion, piece));
        }
    }
    void one(Move move) { list_.push(move); }
    static constexpr bool done() { return false; }

   private:
    MoveList& list_;
};

class CaptureSink {
   public:
    CaptureSink(MoveList& moves, Bitboard enemies)
        : list_(moves), moves_(moves), enemies_(enemies) {}
    void from(Square from, Bitboard targets) { list_.from(from, targets & enemies_); }
    void pawns(int step, Bitboard targets) { list_.pawns(step, targets & enemies_); }
    void promoting(int step, Bitboard targets) {
        while (targets != 0) {
            const Square to = pop(targets);
            moves_.push(make_move(to - step, to, MoveKind::promotion, Piece::queen));
        }
    }
    void one(Move move) {
        if (kind_of(move) == MoveKind::en_passant) moves_.push(move);
    }
    static constexpr bool done() { return false; }

   private:
    ListSink list_;
    MoveList& moves_;
    Bitboard enemies_;
};

// Moves that attack the enemy king, or clear the way for a man that does.
class CheckSink {
   public:
    CheckSink(MoveList& list, const Position& position)
        : list_(list), position_(position), king_(position.king(~position.to_play())) {
        const Player us = position.to_play();
        const Bitboard bishop = bishop_attacks(king_, position.occupied()),
                       rook = rook_attacks(king_, position.occupied());
        from_ = {pawn_attacks(~us, king_), knight_attacks(king_), bishop, rook, bishop | rook, 0};
        // Own men are looked through: one of them in between may step aside.
        Bitboard snipers = position.attackers(us, king_, position.pieces(~us));
        while (snipers != 0) {
            const Bitboard shields = between(king_, pop(snipers)) & position.pieces(us);
            if (!more_than_one(shields)) uncovering_ |= shields;
        }
    }

    void from(Square from, Bitboard targets) {
        const bool uncovers = (uncovering_ & bit(from)) != 0;
        targets &= from_[index(position_.piece_at(from))] | (uncovers ? ~line(king_, from) : 0);
        while (targets != 0) list_.push(make_move(from, pop(targets)));
    }
    void pawns(int step, Bitboard targets) {
        while (targets != 0) {
            const Square to = pop(targets);
            from(to - step, bit(to));
        }
    }
    // A pawn may have stood in the way of what it becomes, or captured one that did.
    void promoting(int step, Bitboard targets) {
        while (targets != 0) {
            const Square to = pop(targets);
            for (const Piece piece : promotions)
                one(make_move(to - step, to, MoveKind::promotion, piece));
        }
    }
    void one(Move move) {
        Position next = position_;
        next.play(move);
        if (next.in_check()) list_.push(move);
    }
    static constexpr bool done() { return false; }

   private:
    MoveList& list_;
    const Position& position_;
    Square king_;
    std::array<Bitboard, piece_kinds> from_{};  // where a man of that kind would give check
    Bitboard uncovering_ = 0;                   // alone between one of ours and the king
};

class CountSink {
   public:
    int count() const { return count_; }
    void from(Square, Bitboard targets) { count_ += std::popcount(targets); }
    void pawns(int, Bitboard targets) { count_ += std::popcount(targets); }
    void promoting(int, Bitboard targets) { count_ += 4 * std::popcount(targets); }
    void one(Move) { ++count_; }
    static constexpr bool done() { return false; }

   private:
    int count_ = 0;
};

// Notices whether there is any move.
class AnySink {
   public:
    void from(Square, Bitboard targets) { any_ |= targets; }
    void pawns(int, Bitboard targets) { any_ |= targets; }
    void promoting(int, Bitboard targets) { any_ |= targets; }
    void one(Move) { any_ = 1; }
    bool done() const { return any_ != 0; }

   private:
    Bitboard any_ = 0;
};

template <Player us, class Sink>
class Generator {
   public:
    Generator(const Position& position, Sink& sink)
        : position_(position),
          sink_(sink),
          king_(position.king(us)),
          own_(position.pieces(us)),
          enemies_(position.pieces(them)),
          occupied_(own_ | enemies_) {}

    void run() {
        find_checkers_and_pins();
        danger_ = attacked();
        sink_.from(king_, king_attacks(king_) & ~own_ & ~danger_);
        if (sink_.done() || more_than_one(checkers_)) return;
        allowed_ = ~own_;
        if (checkers_ != 0)
            allowed_ = checkers_ | between(king_, first_square(checkers_));
        else
            castle();
        pieces();
        if (sink_.done()) return;
        pawns();
        en_passant();
    }

   private:
    static constexpr Player them = ~us;
    static constexpr int up = us == Player::first ? 8 : -8;

    Bitboard own(Piece piece) const { return own_ & position_.pieces(piece); }
    Bitboard enemy(Piece piece) const { return enemies_ & position_.pieces(piece); }

    void find_checkers_and_pins() {
        const Bitboard queens = enemy(Piece::queen);
        checkers_ = (pawn_attacks(us, king_) & enemy(Piece::pawn)) |
                    (knight_attacks(king_) & enemy(Piece::knight));
        // Own pieces are looked through: one of them in between is pinned.
        Bitboard snipers = (bishop_attacks(king_, enemies_) & (enemy(Piece::bishop) | queens)) |
                           (rook_attacks(king_, enemies_) & (enemy(Piece::rook) | queens));
        while (snipers != 0) {
            const Square sniper = pop(snipers);
            const Bitboard shields = between(king_, sniper) & own_;
            if (shields == 0)
                checkers_ |= bit(sniper);
            else if (!more_than_one(shields))
                pinned_ |= shields;
        }
    }

    // All squares that the enemy attacks once the king has stepped aside.
    Bitboard attacked() const {
        const Bitboard without_king = occupied_ ^ bit(king_);
        const Bitboard queens = enemy(Piece::queen);
        Bitboard result =
            pawn_attacks<them>(enemy(Piece::pawn)) | king_attacks(position_.king(them));
        for (Bitboard knights = enemy(Piece::knight); knights != 0;)
            result |= knight_attacks(pop(knights));
        for (Bitboard set = enemy(Piece::bishop) | queens; set != 0;)
            result |= bishop_attacks(pop(set), without_king);
        for (Bitboard set = enemy(Piece::rook) | queens; set != 0;)
            result |= rook_attacks(pop(set), without_king);
        return result;
    }

    void castle() {
        for (Bitboard rooks = position_.castling_rooks() & rank_mask(us, 0); rooks != 0;) {
            const Square rook = pop(rooks);
            const int rank = us == Player::first ? 0 : 7;
            const Square king_to = square_at(rook > king_ ? 6 : 2, rank);
            const Square rook_to = square_at(rook > king_ ? 5 : 3, rank);
            const Bitboard kings_way = between(king_, king_to) | bit(king_to);
            const Bitboard way = kings_way | between(rook, rook_to) | bit(rook_to);
            if (way & occupied_ & ~bit(king_) & ~bit(rook)) continue;
            // In Chess960 the rook may have stood between the king's goal and an attacker.
            if ((kings_way & danger_) || (pinned_ & bit(rook))) continue;
            sink_.one(make_move(king_, rook, MoveKind::castling));
        }
    }

    void pieces() {
        const Bitboard free = ~pinned_;
        for (Bitboard set = own(Piece::knight) & free; set != 0;) {
            const Square from = pop(set);
            sink_.from(from, knight_attacks(from) & allowed_);
        }
        const Bitboard diagonal = own(Piece::bishop) | own(Piece::queen);
        const Bitboard straight = own(Piece::rook) | own(Piece::queen);
        for (Bitboard set = diagonal & free; set != 0;) {
            const Square from = pop(set);
            sink_.from(from, bishop_attacks(from, occupied_) & allowed_);
        }
        for (Bitboard set = straight & free; set != 0;) {
            const Square from = pop(set);
            sink_.from(from, rook_attacks(from, occupied_) & allowed_);
        }
        for (Bitboard set = diagonal & pinned_; set != 0;) {
            const Square from = pop(set);
            sink_.from(from, bishop_attacks(from, occupied_) & allowed_ & line(king_, from));
        }
        for (Bitboard set = straight & pinned_; set != 0;) {
            const Square from = pop(set);
            sink_.from(from, rook_attacks(from, occupied_) & allowed_ & line(king_, from));
        }
    }

    void pawns() {
        const Bitboard all = own(Piece::pawn);
        pawns(all & ~pinned_, allowed_);
        for (Bitboard set = all & pinned_; set != 0;) {
            const Square from = pop(set);
            pawns(bit(from), allowed_ & line(king_, from));
        }
    }

    void pawns(Bitboard set, Bitboard allowed) {
        const Bitboard last = set & rank_mask(us, 6), others = set ^ last;
        const Bitboard step = shift<us, 1, 0>(others) & ~occupied_;
        const Bitboard leap = shift<us, 1, 0>(step & rank_mask(us, 2)) & ~occupied_;
        const Bitboard victims = enemies_ & allowed;
        sink_.pawns(up, step & allowed);
        sink_.pawns(2 * up, leap & allowed);
        sink_.pawns(up - 1, shift<us, 1, -1>(others) & victims);
        sink_.pawns(up + 1, shift<us, 1, 1>(others) & victims);
        if (last == 0) return;
        sink_.promoting(up, shift<us, 1, 0>(last) & ~occupied_ & allowed);
        sink_.promoting(up - 1, shift<us, 1, -1>(last) & victims);
        sink_.promoting(up + 1, shift<us, 1, 1>(last) & victims);
    }

    void en_passant() {
        const auto to = position_.en_passant();
        if (!to) return;
        for (Bitboard set = pawn_attacks(them, *to) & own(Piece::pawn); set != 0;) {
            const Square from = pop(set);
            if (position_.en_passant_legal(from, *to))
                sink_.one(make_move(from, *to, MoveKind::en_passant));
        }
    }

    const Position& position_;
    Sink& sink_;
    const Square king_;
    const Bitboard own_, enemies_, occupied_;
    Bitboard checkers_ = 0, pinned_ = 0, danger_ = 0, allowed_ = 0;
};

template <class Sink>
void generate(const Position& position, Sink& sink) {
    if (position.to_play() == Player::first)
        Generator<Player::first, Sink>(position, sink).run();
    else
        Generator<Player::second, Sink>(position, sink).run();
}

}  // namespace

MoveList Position::legal_moves() const {
    MoveList moves;
    ListSink sink(moves);
    generate(*this, sink);
    return moves;
}

MoveList Position::captures() const {
    MoveList moves;
    CaptureSink sink(moves, pieces(~to_play_));
    generate(*this, sink);
    return moves;
}

MoveList Position::checks() const {
    MoveList moves;
    CheckSink sink(moves, *this);
    generate(*this, sink);
    return moves;
}

int Position::count_legal_moves() const {
    CountSink sink;
    generate(*this, sink);
    return sink.count();
}

bool Position::has_legal_move() const {
    AnySink sink;
    generate(*this, sink);
    return sink.done();
}

std::uint64_t Position::perft(int depth) const {
    if (depth == 0) return 1;
    if (depth == 1) return static_cast<std::uint64_t>(count_legal_moves());
    std::uint64_t nodes = 0;
    for (const Move move : legal_moves()) {
        Position next = *this;
        next.play(move);
        nodes += next.perft(depth - 1);
    }
    return nodes;
}

}  // namespace chess
