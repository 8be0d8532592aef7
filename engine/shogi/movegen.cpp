#include "engine/shogi/movegen.h"

#include <array>

namespace shogi {
namespace {

using engine::MoveList;

// Sinks: what becomes of the moves that the generator finds, given as sets of target squares.
struct List {
    static constexpr bool with_drops = true;
    void pawns(Bitboard plain, Bitboard promoting, int back) {
        for_each(promoting, [&](int to) { list.push(board_move(to + back, to, true)); });
        for_each(plain, [&](int to) { list.push(board_move(to + back, to)); });
    }
    void moves(int from, Bitboard plain, Bitboard promoting) {
        for_each(promoting, [&](int to) { list.push(board_move(from, to, true)); });
        for_each(plain, [&](int to) { list.push(board_move(from, to)); });
    }
    void drops(Kind kind, Bitboard targets) {
        for_each(targets, [&](int to) { list.push(drop_move(kind, to)); });
    }
    static constexpr bool enough() { return false; }

    MoveList& list;
};

// Of moves that may promote only those that do.
struct Captures {
    static constexpr bool with_drops = false;
    void pawns(Bitboard plain, Bitboard promoting, int back) {
        List{list}.pawns(plain & ~promoting & enemies, promoting, back);
    }
    void moves(int from, Bitboard plain, Bitboard promoting) {
        List{list}.moves(from, plain & ~promoting & enemies, promoting & enemies);
    }
    void drops(Kind, Bitboard) {}
    static constexpr bool enough() { return false; }

    MoveList& list;
    Bitboard enemies;
};

constexpr Bitboard between(int direction, int from, int to) {
    return ray(direction, from) & ~ray(direction, to) & ~bit(to);
}

// The squares where a check from `checker` can be met: its own and those on the way.
constexpr Bitboard answers_to(int king, int checker) {
    for (int direction = 0; direction < 8; ++direction)
        if (has(ray(direction, king), checker))
            return between(direction, king, checker) | bit(checker);
    return bit(checker);
}

// Moves that attack the enemy king, or clear the way for a piece that does. None attacks it before,
// so the piece that moves does not block its own way.
template <Player us>
class Checks {
   public:
    static constexpr bool with_drops = true;

    Checks(MoveList& list, const Position& position)
        : list_(list), position_(position), king_(position.king(~us)) {
        const Bitboard occupied = position.occupied();
        const Bitboard bishop = bishop_attacks(king_, occupied),
                       rook = rook_attacks(king_, occupied), around = king_attacks(king_);
        from_[index(Kind::pawn)] = pawn_attacks<~us>(king_);
        from_[index(Kind::lance)] = lance_attacks<~us>(king_, occupied);
        from_[index(Kind::knight)] = knight_attacks<~us>(king_);
        from_[index(Kind::silver)] = silver_attacks<~us>(king_);
        for (const Kind kind : {Kind::gold, Kind::tokin, Kind::promoted_lance,
                                Kind::promoted_knight, Kind::promoted_silver})
            from_[index(kind)] = gold_attacks<~us>(king_);
        from_[index(Kind::bishop)] = bishop;
        from_[index(Kind::rook)] = rook;
        from_[index(Kind::horse)] = bishop | around;
        from_[index(Kind::dragon)] = rook | around;
        // Own pieces are looked through: one of them in between may step aside.
        for_each(position.attackers(us, king_, position.of(~us)), [&](int sniper) {
            const Bitboard shields = answers_to(king_, sniper) & ~bit(sniper) & position.of(us);
            if ((shields & (shields - 1)) == 0) uncovering_ |= shields;
        });
    }

    void pawns(Bitboard plain, Bitboard promoting, int back) {
        for_each(promoting, [&](int to) { single(to + back, to, true); });
        for_each(plain, [&](int to) { single(to + back, to, false); });
    }
    void moves(int from, Bitboard plain, Bitboard promoting) {
        const Kind kind = position_.at(from).kind();
        const Bitboard always = uncovered_by(from);
        for_each(promoting & (from_[index(promoted(kind))] | always),
                 [&](int to) { list_.push(board_move(from, to, true)); });
        for_each(plain & (from_[index(kind)] | always),
                 [&](int to) { list_.push(board_move(from, to)); });
    }
    void drops(Kind kind, Bitboard targets) {
        for_each(targets & from_[index(kind)], [&](int to) { list_.push(drop_move(kind, to)); });
    }
    static constexpr bool enough() { return false; }

   private:
    void single(int from, int to, bool promotes) {
        moves(from, promotes ? 0 : bit(to), promotes ? bit(to) : 0);
    }
    // Where a piece on `from` may go for another to give check.
    Bitboard uncovered_by(int from) const {
        if (!has(uncovering_, from)) return 0;
        int direction = 0;
        while (!has(ray(direction, king_), from)) ++direction;
        return ~ray(direction, king_);
    }

    MoveList& list_;
    const Position& position_;
    int king_;
    std::array<Bitboard, kind_count> from_{};  // where a piece of that kind would give check
    Bitboard uncovering_ = 0;                  // alone between one of ours and the king
};

struct Count {
    static constexpr bool with_drops = true;
    void pawns(Bitboard plain, Bitboard promoting, int) {
        total += count(plain) + count(promoting);
    }
    void moves(int, Bitboard plain, Bitboard promoting) {
        total += count(plain) + count(promoting);
    }
    void drops(Kind, Bitboard targets) { total += count(targets); }
    static constexpr bool enough() { return false; }

    int total = 0;
};

struct Any {
    static constexpr bool with_drops = true;
    void pawns(Bitboard plain, Bitboard promoting, int) { found |= plain | promoting; }
    void moves(int, Bitboard plain, Bitboard promoting) { found |= plain | promoting; }
    void drops(Kind, Bitboard targets) { found |= targets; }
    bool enough() const { return found != 0; }

    Bitboard found = 0;
};

template <Player us, Kind kind>
constexpr Bitboard reach(int from, Bitboard occupied) {
    if constexpr (kind == Kind::pawn) return pawn_attacks<us>(from);
    if constexpr (kind == Kind::lance) return lance_attacks<us>(from, occupied);
    if constexpr (kind == Kind::knight) return knight_attacks<us>(from);
    if constexpr (kind == Kind::silver) return silver_attacks<us>(from);
    if constexpr (kind == Kind::gold) return gold_attacks<us>(from);
    if constexpr (kind == Kind::bishop) return bishop_attacks(from, occupied);
    if constexpr (kind == Kind::rook) return rook_attacks(from, occupied);
    if constexpr (kind == Kind::horse) return horse_attacks(from, occupied);
    if constexpr (kind == Kind::dragon) return dragon_attacks(from, occupied);
}

// Squares where a piece of the kind would never move again.
template <Player us, Kind kind>
constexpr Bitboard dead_ends() {
    if constexpr (kind == Kind::pawn || kind == Kind::lance) return last_rank<us>;
    if constexpr (kind == Kind::knight) return last_two_ranks<us>;
    return 0;
}

template <Player us, class Sink>
class Generator {
   public:
    Generator(const Position& position, Sink& sink)
        : position_(position), sink_(sink), own_(position.of(us)), occupied_(position.occupied()) {}

    void run() {
        if (position_.has_king(us)) king();
        if (targets_ == 0 || sink_.enough()) return;
        const Bitboard free = own_ & ~pinned_;
        pawns(free & position_.of(Kind::pawn), targets_);
        all<Kind::lance>(free);
        all<Kind::knight>(free);
        all<Kind::silver>(free);
        moves<Kind::gold>(free & position_.gold_movers());
        all<Kind::bishop>(free);
        all<Kind::rook>(free);
        all<Kind::horse>(free);
        all<Kind::dragon>(free);
        if constexpr (Sink::with_drops)
            if (!sink_.enough() && !position_.hand_empty(us)) drops();
    }

   private:
    static constexpr Player them = ~us;

    // Also finds what the king demands of the other pieces.
    void king() {
        const int king = position_.king(us);
        const Bitboard attacked = attacked_squares<them>(position_, occupied_ ^ bit(king));
        sink_.moves(king, king_attacks(king) & ~own_ & ~attacked, 0);
        if (has(attacked, king)) {
            const Bitboard checkers = position_.attackers(them, king, occupied_);
            targets_ = (checkers & (checkers - 1)) == 0 ? answers_to(king, first(checkers)) : 0;
        }
        if (targets_ != 0)
            for (int direction = 0; direction < 8; ++direction)
                pinned_on(direction, king, ray(direction, king) & sliders(direction));
    }

    Bitboard sliders(int direction) const {
        const Bitboard theirs = position_.of(them);
        if (direction >= 4)
            return theirs & (position_.of(Kind::bishop) | position_.of(Kind::horse));
        const Bitboard rooks = position_.of(Kind::rook) | position_.of(Kind::dragon);
        const bool lances_too = direction == (us == Player::first ? up : down);
        return theirs & (lances_too ? rooks | position_.of(Kind::lance) : rooks);
    }

    void pinned_on(int direction, int king, Bitboard snipers) {
        for_each(snipers, [&](int sniper) {
            const Bitboard way = between(direction, king, sniper);
            const Bitboard blockers = way & occupied_;
            if ((blockers & (blockers - 1)) != 0 || (blockers & own_) == 0) return;
            pinned_ |= blockers;
            move_pinned(first(blockers), targets_ & (way | bit(sniper)));
        });
    }

    void move_pinned(int from, Bitboard allowed) {
        switch (position_.at(from).kind()) {
            case Kind::pawn:
                return pawns(bit(from), allowed);
            case Kind::lance:
                return move<Kind::lance>(from, allowed);
            case Kind::knight:
                return;
            case Kind::silver:
                return move<Kind::silver>(from, allowed);
            case Kind::bishop:
                return move<Kind::bishop>(from, allowed);
            case Kind::rook:
                return move<Kind::rook>(from, allowed);
            case Kind::horse:
                return move<Kind::horse>(from, allowed);
            case Kind::dragon:
                return move<Kind::dragon>(from, allowed);
            default:
                return move<Kind::gold>(from, allowed);
        }
    }

    template <Kind kind>
    void all(Bitboard free) {
        moves<kind>(free & position_.of(kind));
    }

    template <Kind kind>
    void moves(Bitboard pieces) {
        const Bitboard allowed = targets_ & ~own_;
        for_each(pieces, [&](int from) { move<kind>(from, allowed); });
    }

    template <Kind kind>
    void move(int from, Bitboard allowed) {
        const Bitboard to = reach<us, kind>(from, occupied_) & allowed;
        if constexpr (can_promote(kind)) {
            const Bitboard promoting = has(promotion_zone<us>, from) ? to : to & promotion_zone<us>;
            sink_.moves(from, to & ~dead_ends<us, kind>(), promoting);
        } else {
            sink_.moves(from, to, 0);
        }
    }

    void pawns(Bitboard pieces, Bitboard allowed) {
        const Bitboard to = step_forward<us>(pieces) & allowed & ~own_;
        sink_.pawns(to & ~last_rank<us>, to & promotion_zone<us>, us == Player::first ? 1 : -1);
    }

    void drops() {
        const Bitboard empty = targets_ & ~occupied_;
        if (empty == 0) return;
        drop_pawns(empty);
        drop<Kind::lance>(empty);
        drop<Kind::knight>(empty);
        drop<Kind::silver>(empty);
        drop<Kind::gold>(empty);
        drop<Kind::bishop>(empty);
        drop<Kind::rook>(empty);
    }

    template <Kind kind>
    void drop(Bitboard empty) {
        if (position_.hand(us, kind) != 0) sink_.drops(kind, empty & ~dead_ends<us, kind>());
    }

    void drop_pawns(Bitboard empty) {
        if (position_.hand(us, Kind::pawn) == 0) return;
        Bitboard to = empty & ~last_rank<us> & files_without(position_.of(us, Kind::pawn));
        if (position_.has_king(them)) {
            const Bitboard checking = to & pawn_attacks<them>(position_.king(them));
            if (checking != 0 && drop_mates(first(checking))) to ^= checking;
        }
        sink_.drops(Kind::pawn, to);
    }

    // Whether a pawn dropped before their king leaves them without a move.
    bool drop_mates(int square) const {
        if (position_.attackers(us, square, occupied_) == 0) return false;
        Position after = position_;
        after.play_as<us>(drop_move(Kind::pawn, square));
        Any any;
        Generator<them, Any>(after, any).run();
        return !any.enough();
    }

    const Position& position_;
    Sink& sink_;
    const Bitboard own_, occupied_;
    Bitboard targets_ = all_squares, pinned_ = 0;
};

template <class Sink>
void run(const Position& position, Sink& sink) {
    if (position.to_play() == Player::first)
        Generator<Player::first, Sink>(position, sink).run();
    else
        Generator<Player::second, Sink>(position, sink).run();
}

}  // namespace

MoveList legal_moves(const Position& position) {
    MoveList moves;
    List sink{moves};
    run(position, sink);
    return moves;
}

MoveList captures(const Position& position) {
    MoveList moves;
    Captures sink{moves, position.of(~position.to_play())};
    run(position, sink);
    return moves;
}

namespace {

template <Player us>
void run_checks(const Position& position, MoveList& moves) {
    Checks<us> sink(moves, position);
    Generator<us, Checks<us>>(position, sink).run();
}

}  // namespace

MoveList checks(const Position& position) {
    MoveList moves;
    if (!position.has_king(~position.to_play())) return moves;
    if (position.to_play() == Player::first)
        run_checks<Player::first>(position, moves);
    else
        run_checks<Player::second>(position, moves);
    return moves;
}

int count_legal_moves(const Position& position) {
    Count sink;
    run(position, sink);
    return sink.total;
}

bool has_legal_move(const Position& position) {
    Any sink;
    run(position, sink);
    return sink.enough();
}

template <Player us>
MoveList legal_moves_as(const Position& position) {
    MoveList moves;
    List sink{moves};
    Generator<us, List>(position, sink).run();
    return moves;
}

template <Player us>
int count_legal_moves_as(const Position& position) {
    Count sink;
    Generator<us, Count>(position, sink).run();
    return sink.total;
}

template MoveList legal_moves_as<Player::first>(const Position&);
template MoveList legal_moves_as<Player::second>(const Position&);
template int count_legal_moves_as<Player::first>(const Position&);
template int count_legal_moves_as<Player::second>(const Position&);

}  // namespace shogi
