#include "engine/go/go.h"

#include <algorithm>
#include <cassert>

#include "engine/go/score.h"

namespace go {

Go::Go(int size, Komi komi, const Rules& rules) : board_(size), komi_(komi), rules_(rules) {
    forget();
}

std::uint64_t Go::position_key(std::uint64_t stones, Player mover) const {
    return (stones & ~mover_bit) | side(mover);
}

// Starts the history anew with the position as it is.
void Go::forget() {
    positions_.assign(1, position_key(board_.key(), to_play_));
    taken_off_ = {};
    recent_ = {};
    last_moves_ = {};
    recent_[0] = board_.stones();
    move_count_ = 0;
    stone_surplus_ = 0;
    passes_ = 0;
    ko_ = 0;
    no_result_ = false;
}

void Go::set_to_play(Player player) {
    if (player == to_play_) return;
    to_play_ = player;
    ko_ = 0;
    positions_.back() = position_key(board_.key(), to_play_);
}

std::optional<Player> Go::at(Point point) const {
    const auto colour = board_.at(index(point));
    return colour == Colour::empty ? std::nullopt : std::optional(player_of(colour));
}

Move Go::move_at(Point point) const { return {static_cast<std::uint16_t>(index(point))}; }

std::optional<Point> Go::point_of(Move move) const {
    if (move == pass) return {};
    return Point{board_.x(move.code), board_.y(move.code)};
}

std::optional<Point> Go::ko_point() const { return point_of({ko_}); }

const Stones& Go::stones_before(int ago) const {
    static constexpr Stones none;
    assert(ago >= 0 && ago < remembered);
    if (ago > move_count_) return none;
    return recent_[static_cast<std::size_t>((move_count_ - ago) % remembered)];
}

std::optional<Move> Go::move_before(int ago) const {
    assert(ago >= 0 && ago < remembered);
    if (ago >= move_count_) return {};
    return last_moves_[static_cast<std::size_t>((move_count_ - ago) % remembered)];
}

// Would a stone of the mover's there bring back an earlier position, as superko forbids?
bool Go::repeats(int at) const {
    const auto colour = colour_of(to_play_);
    const bool possible = taken_off_[side(to_play_)][board_.order(at)] ||
                          (rules_.suicide && board_.is_suicide(at, colour));
    if (!possible) return false;
    const auto after = position_key(board_.key_after(at, colour), ~to_play_);
    const auto ignored = rules_.ko == Ko::positional ? mover_bit : 0;
    return std::any_of(positions_.begin(), positions_.end(),
                       [&](std::uint64_t key) { return ((key ^ after) & ~ignored) == 0; });
}

std::string_view Go::why_illegal(Move move) const {
    if (move == pass) return {};
    const int at = move.code;
    const auto colour = colour_of(to_play_);
    if (!board_.holds(at) || board_.at(at) != Colour::empty) return "occupied";
    if (at == ko_) return "ko";
    if (board_.is_suicide(at, colour)) {
        const auto beside = board_.neighbours(at);
        const bool joins = std::any_of(beside.begin(), beside.end(),
                                       [&](int point) { return board_.at(point) == colour; });
        if (!rules_.suicide || !joins) return "suicide";
    }
    if (rules_.ko != Ko::simple && repeats(at)) return "superko";
    return {};
}

bool Go::legal(Move move) const { return why_illegal(move).empty(); }

MoveList Go::legal_moves() const {
    MoveList moves;
    board_.for_each_point([&](int at) {
        const Move move{static_cast<std::uint16_t>(at)};
        if (board_.at(at) == Colour::empty && legal(move)) moves.push(move);
    });
    moves.push(pass);
    return moves;
}

void Go::play(Move move) {
    assert(legal(move));
    const int at = move.code;
    ko_ = 0;
    if (move == pass) {
        passes_ = static_cast<std::uint8_t>(std::min(passes_ + 1, 200));
    } else {
        passes_ = 0;
        play_stone(at);
    }
    to_play_ = ~to_play_;
    remember(move);
}

void Go::play_stone(int at) {
    const auto mover = side(to_play_);
    stone_surplus_ += to_play_ == Player::first ? 1 : -1;
    const auto before = board_.stones();
    const auto taken = board_.play(at, colour_of(to_play_));
    captured_[mover] += taken.enemy;
    captured_[1 - mover] += taken.own;
    if (taken.enemy + taken.own == 0) return;
    for (const std::size_t player : {0u, 1u})
        taken_off_[player] |= before[player] & ~board_.stones()[player];
    const bool takes_ko =
        taken.enemy == 1 && board_.is_lone_stone(at) && board_.liberties(at, 2) == 1;
    if (takes_ko) ko_ = static_cast<std::uint16_t>(taken.last);
}

void Go::remember(Move move) {
    const auto key = position_key(board_.key(), to_play_);
    ++move_count_;
    const auto slot = static_cast<std::size_t>(move_count_ % remembered);
    recent_[slot] = board_.stones();
    last_moves_[slot] = move;
    positions_.push_back(key);
    const bool may_repeat = move != pass && rules_.ko == Ko::simple &&
                            (board_.at(move.code) == Colour::empty ||
                             taken_off_[side(~to_play_)][board_.order(move.code)]);
    no_result_ = may_repeat && std::count(positions_.begin(), positions_.end(), key) >= 3;
}

bool Go::fills_own_eye(Move move) const {
    if (move == pass) return false;
    const auto colour = colour_of(to_play_);
    bool at_edge = false;
    for (const int beside : board_.neighbours(move.code)) {
        const auto there = board_.at(beside);
        if (there != colour && there != Colour::edge) return false;
        at_edge = at_edge || there == Colour::edge;
    }
    int enemies = at_edge ? 1 : 0;
    for (const int corner : board_.diagonals(move.code))
        enemies += board_.at(corner) == opponent(colour);
    return enemies < 2;
}

void Go::set_up(Point point, std::optional<Player> stone) {
    board_.set_up(index(point), stone ? colour_of(*stone) : Colour::empty);
    forget();
}

void Go::take_dead(Point point) {
    const auto stone = at(point);
    if (!stone) return;
    ++captured_[side(~*stone)];
    set_up(point, {});
}

bool Go::every_chain_has_liberty() const {
    bool all = true;
    board_.for_each_point(
        [&](int at) { all = all && (board_.at(at) == Colour::empty || board_.has_liberty(at)); });
    return all;
}

int Go::white_bonus() const {
    if (handicap_ < 2 || rules_.white_handicap_bonus == HandicapBonus::none) return 0;
    return rules_.white_handicap_bonus == HandicapBonus::stones ? handicap_ : handicap_ - 1;
}

Outcome Go::outcome() const {
    if (no_result_) return Outcome::draw;
    return passes_ < 2 ? Outcome::ongoing : score(*this).outcome();
}

std::uint64_t Go::key() const {
    const auto decider = static_cast<std::uint64_t>(size()) << 32 |
                         static_cast<std::uint64_t>(ko_) << 8 | side(to_play_);
    return board_.key() ^ decider * 0x9e3779b97f4a7c15;
}

}  // namespace go
