#include "engine/shogi/shogi.h"

#include <algorithm>
#include <array>

#include "engine/shogi/movegen.h"
#include "engine/shogi/perft.h"
#include "engine/shogi/sfen.h"
#include "engine/shogi/usi.h"

namespace shogi {
namespace {

constexpr std::array<std::string_view, 6> rule_names{"NoEnteringKing", "CSARule24",  "CSARule24H",
                                                     "CSARule27",      "CSARule27H", "TryRule"};

constexpr int full_points = 54;  // 2 rooks and 2 bishops at 5, 34 others at 1

int points_on(const Position& position, Bitboard squares) {
    const Bitboard big = position.of(Kind::bishop) | position.of(Kind::rook) |
                         position.of(Kind::horse) | position.of(Kind::dragon);
    return count(squares & ~position.of(Kind::king)) + 4 * count(squares & big);
}

int points_in_hand(const Position& position, Player player) {
    int points = 0;
    for (const Kind kind : hand_kinds)
        points +=
            position.hand(player, kind) * (kind == Kind::bishop || kind == Kind::rook ? 5 : 1);
    return points;
}

// What the board and both hands hold short of a full set.
int missing_points(const Position& position) {
    return full_points - points_on(position, position.occupied()) -
           points_in_hand(position, Player::first) - points_in_hand(position, Player::second);
}

int points_to_declare(const Position& position, Player player, DeclarationRule rule) {
    const bool by_24 =
        rule == DeclarationRule::csa_rule_24 || rule == DeclarationRule::csa_rule_24_h;
    const bool handicap =
        rule == DeclarationRule::csa_rule_24_h || rule == DeclarationRule::csa_rule_27_h;
    if (player == Player::first) return by_24 ? 31 : 28;
    return (by_24 ? 31 : 27) - (handicap ? missing_points(position) : 0);
}

Bitboard enemy_camp(Player player) {
    return player == Player::first ? promotion_zone<Player::first> : promotion_zone<Player::second>;
}

}  // namespace

std::span<const std::string_view> declaration_rule_names() { return rule_names; }

std::optional<DeclarationRule> declaration_rule_from_name(std::string_view name) {
    const auto* const found = std::find(rule_names.begin(), rule_names.end(), name);
    if (found == rule_names.end()) return std::nullopt;
    return static_cast<DeclarationRule>(found - rule_names.begin());
}

Shogi::Shogi(const Position& position, int next_move)
    : position_(position),
      past_{{.key = position.key()}},
      moves_before_(next_move - 1),
      in_check_(position.in_check()) {}

Outcome Shogi::outcome() const {
    if (repetition_outcome_ != Outcome::ongoing) return repetition_outcome_;
    if (tried() || !has_legal_move(position_)) return engine::win_for(~to_play());
    if (can_declare_win()) return engine::win_for(to_play());
    return move_limit_ > 0 && move_count() >= move_limit_ ? Outcome::draw : Outcome::ongoing;
}

bool Shogi::tried() const {
    const Player mover = ~to_play();
    return declaration_rule_ == DeclarationRule::try_rule &&
           has(position_.of(mover, Kind::king), square_at(4, mover == Player::first ? 0 : 8));
}

bool Shogi::can_declare_win() const {
    if (declaration_rule_ == DeclarationRule::no_entering_king ||
        declaration_rule_ == DeclarationRule::try_rule)
        return false;
    const Player player = to_play();
    const Bitboard entered = position_.of(player) & enemy_camp(player);
    if (in_check_ || (entered & position_.of(Kind::king)) == 0 || count(entered) < 11) return false;
    return points_on(position_, entered) + points_in_hand(position_, player) >=
           points_to_declare(position_, player, declaration_rule_);
}

std::uint64_t Shogi::perft(int depth) const { return shogi::perft(position_, depth); }

MoveList Shogi::legal_moves() const { return shogi::legal_moves(position_); }

std::optional<engine::ForcedMate> Shogi::forced_mate() const {
    const auto mate = engine::find_forced_mate(position_);
    const bool in_time = !mate || move_limit_ == 0 || move_count() + mate->plies <= move_limit_;
    return in_time ? mate : std::nullopt;
}

void Shogi::play(Move move) {
    const auto mover = index(to_play());
    const Piece captured = position_.at(to_square(move));
    position_.play(move);
    in_check_ = position_.in_check();
    checks_in_a_row_[mover] = in_check_ ? checks_in_a_row_[mover] + 1 : 0;
    const auto key = position_.key();
    const int earlier = earlier_occurrences(key);
    past_.push_back({key, move, captured, static_cast<std::uint8_t>(std::min(earlier, 255))});
    repetition_outcome_ = earlier >= 3 ? repetition_outcome() : Outcome::ongoing;
}

// Called before the position is entered into past_.
int Shogi::earlier_occurrences(std::uint64_t key) const {
    for (auto i = plies() - 4; i >= 0; i -= 2)
        if (past_[at(i)].key == key) return past_[at(i)].repetitions + 1;
    return 0;
}

Outcome Shogi::repetition_outcome() const {
    const auto key = past_.back().key;
    const auto first =
        std::find_if(past_.begin(), past_.end(), [key](const Ply& ply) { return ply.key == key; });
    const auto moves_each = (past_.end() - 1 - first) / 2;
    const bool first_checks = checks_in_a_row_[0] >= moves_each,
               second_checks = checks_in_a_row_[1] >= moves_each;
    if (first_checks == second_checks) return Outcome::draw;
    return first_checks ? Outcome::second_wins : Outcome::first_wins;
}

Position Shogi::position_before(int back) const {
    Position position = position_;
    for (int i = 0; i < back; ++i) {
        const Ply& ply = past_[past_.size() - 1 - at(i)];
        position.take_back(ply.move, ply.captured);
    }
    return position;
}

Shogi Shogi::from_text(std::string_view text) {
    const auto [position, next_move] = parse_sfen(text);
    return Shogi(position, next_move);
}

std::string Shogi::to_text() const { return to_sfen(position_, move_count() + 1); }

std::optional<Move> Shogi::move_from_text(std::string_view text) const {
    const auto move = parse_usi_move(text);
    return move && legal_moves().contains(*move) ? move : std::nullopt;
}

std::string Shogi::move_to_text(Move move) const { return to_usi(move); }

}  // namespace shogi
