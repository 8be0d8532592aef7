#include "engine/shogi/position.h"

#include <cassert>

namespace shogi {
namespace {

constexpr std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
}

using SquareKeys = std::array<std::array<std::uint64_t, square_count>, 32>;

constexpr SquareKeys make_square_keys() {
    SquareKeys keys{};
    std::uint64_t seed = 0x5a0b3c7d19e2f468;
    for (auto& piece : keys)
        for (auto& key : piece) key = mix(seed += 0x9e3779b97f4a7c15);
    return keys;
}
constexpr SquareKeys square_keys = make_square_keys();

constexpr std::uint64_t key_of(Piece piece, int square) {
    return square_keys[piece.code()][static_cast<std::size_t>(square)];
}

}  // namespace

Position Position::start() {
    constexpr std::array back{Kind::lance, Kind::knight, Kind::silver, Kind::gold, Kind::king,
                              Kind::gold,  Kind::silver, Kind::knight, Kind::lance};
    Position position;
    const auto put_both = [&](int square, Kind kind) {
        position.put(square, {Player::first, kind});
        position.put(turned(square), {Player::second, kind});
    };
    for (int file = 0; file < board_size; ++file) {
        put_both(square_at(file, 8), back[static_cast<std::size_t>(file)]);
        put_both(square_at(file, 6), Kind::pawn);
    }
    put_both(square_at(1, 7), Kind::rook);
    put_both(square_at(7, 7), Kind::bishop);
    return position;
}

std::uint64_t Position::key() const {
    const auto hand = [&](Player player) {
        return std::bit_cast<std::uint64_t>(hands_[index(player)]);
    };
    const auto hands = mix(hand(Player::first) + 0x9e3779b97f4a7c15) ^
                       mix(hand(Player::second) + 0x3c6ef372fe94f82b);
    return board_key_ ^ hands ^ (to_play_ == Player::first ? 0 : 0x8f14e45fceea167a);
}

Bitboard Position::attackers(Player player, int square, Bitboard occupied) const {
    const auto at = static_cast<std::size_t>(square);
    const auto back = index(~player);
    const Bitboard rooks = of(Kind::rook) | of(Kind::dragon);
    const Bitboard bishops = of(Kind::bishop) | of(Kind::horse);
    const Bitboard files = file_attacks(square, occupied);
    const Bitboard reach =
        (tables::pawn[back][at] & of(Kind::pawn)) | (tables::knight[back][at] & of(Kind::knight)) |
        (tables::silver[back][at] & of(Kind::silver)) | (tables::gold[back][at] & gold_movers()) |
        (tables::king[at] & of(Kind::king)) | (tables::cross[at] & of(Kind::horse)) |
        (tables::diagonal[at] & of(Kind::dragon)) |
        (files & ray(player == Player::first ? down : up, square) & of(Kind::lance)) |
        (files & rooks) | (slide_on(tables::rank_line[at], square, occupied) & rooks) |
        (bishop_attacks(square, occupied) & bishops);
    return reach & of(player);
}

Bitboard Position::checkers() const {
    return has_king(to_play_) ? attackers(~to_play_, king(to_play_), occupied()) : 0;
}

void Position::put(int square, Piece piece) {
    assert(at(square).empty() && !piece.empty());
    board_[static_cast<std::size_t>(square)] = piece;
    by_player_[index(piece.player())] |= bit(square);
    by_kind_[index(piece.kind())] |= bit(square);
    board_key_ ^= key_of(piece, square);
}

void Position::remove(int square) {
    const Piece piece = at(square);
    assert(!piece.empty());
    board_[static_cast<std::size_t>(square)] = {};
    by_player_[index(piece.player())] ^= bit(square);
    by_kind_[index(piece.kind())] ^= bit(square);
    board_key_ ^= key_of(piece, square);
}

template <Player us>
void Position::capture(int square) {
    const Kind kind = at(square).kind();
    remove(square);
    ++hands_[index(us)][index(unpromoted(kind))];
}

template <Player us>
void Position::play_as(Move move) {
    const int to = to_square(move);
    to_play_ = ~us;
    if (is_drop(move)) {
        const Kind kind = dropped_kind(move);
        --hands_[index(us)][index(kind)];
        return put(to, {us, kind});
    }
    const int from = from_square(move);
    const Kind kind = at(from).kind();
    remove(from);
    if (!at(to).empty()) capture<us>(to);
    put(to, {us, is_promotion(move) ? promoted(kind) : kind});
}

template void Position::play_as<Player::first>(Move);
template void Position::play_as<Player::second>(Move);

void Position::play(Move move) {
    if (to_play_ == Player::first) return play_as<Player::first>(move);
    play_as<Player::second>(move);
}

void Position::take_back(Move move, Piece captured) {
    to_play_ = ~to_play_;
    const int to = to_square(move);
    const Kind kind = at(to).kind();
    remove(to);
    if (is_drop(move)) {
        ++hands_[index(to_play_)][index(kind)];
        return;
    }
    put(from_square(move), {to_play_, is_promotion(move) ? unpromoted(kind) : kind});
    if (captured.empty()) return;
    put(to, captured);
    --hands_[index(to_play_)][index(unpromoted(captured.kind()))];
}

template <Player player>
Bitboard attacked_squares(const Position& position, Bitboard occupied) {
    const Bitboard own = position.of(player);
    const Bitboard silvers = position.of(Kind::silver), golds = position.gold_movers(),
                   kings = position.of(Kind::king), horses = position.of(Kind::horse),
                   dragons = position.of(Kind::dragon);
    const auto forward = [](Bitboard set) { return step_forward<player>(set); };
    const auto backward = [](Bitboard set) { return step_forward<~player>(set); };
    const Bitboard straight = own & (golds | kings | horses);
    // Moves that change file by one: first along the file, then all sideways at once.
    const Bitboard shifted = straight | forward(own & (silvers | golds | kings | dragons)) |
                             backward(own & (silvers | kings | dragons)) |
                             forward(forward(own & position.of(Kind::knight)));
    Bitboard reached = step_sideways(shifted) | backward(straight) |
                       forward(straight | (own & (silvers | position.of(Kind::pawn))));
    for_each(own & position.of(Kind::lance),
             [&](int square) { reached |= lance_attacks<player>(square, occupied); });
    for_each(own & (position.of(Kind::bishop) | horses),
             [&](int square) { reached |= bishop_attacks(square, occupied); });
    for_each(own & (position.of(Kind::rook) | dragons),
             [&](int square) { reached |= rook_attacks(square, occupied); });
    return reached;
}

template Bitboard attacked_squares<Player::first>(const Position&, Bitboard);
template Bitboard attacked_squares<Player::second>(const Position&, Bitboard);

}  // namespace shogi
