// Shogi by the rules of the Japan Shogi Association: one game in progress.
//
// Black (sente) is Player::first. A player without a legal move has lost; a position's fourth
// occurrence is a draw, or lost for the player all of whose moves since the first one gave check;
// a player entitled to declare a win is taken to do so; a move limit, where one is set, draws.
// A game that is over by repetition, declaration or limit may be played on, as records do. The
// attacker of a mate problem may have no king.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/encoding.h"
#include "engine/forced_mate.h"
#include "engine/game.h"
#include "engine/shogi/movegen.h"
#include "engine/shogi/position.h"

namespace shogi {

using engine::MoveList;
using engine::Outcome;

// When a player whose king has entered the enemy's camp may declare the game won: by 24 or 27
// points, H counting what a handicap left out for White; or by the king reaching 5a or 5i (try).
// Named as USI engines name the values of EnteringKingRule.
enum class DeclarationRule : std::uint8_t {
    no_entering_king,
    csa_rule_24,
    csa_rule_24_h,
    csa_rule_27,
    csa_rule_27_h,
    try_rule,
};
// In the order of the enumerators: "NoEnteringKing", "CSARule24" …
std::span<const std::string_view> declaration_rule_names();
std::optional<DeclarationRule> declaration_rule_from_name(std::string_view name);

class Rollouts;
class Exchanges;

class Shogi {
   public:
    using Rollouts = shogi::Rollouts;    // engine/shogi/rollouts.h
    using Exchanges = shogi::Exchanges;  // engine/shogi/exchanges.h
    static constexpr std::string_view name = "shogi";

    Shogi() : Shogi(Position::start()) {}
    // `next_move` counts from 1 and matters to the move limit only.
    explicit Shogi(const Position& position, int next_move = 1);

    bool operator==(const Shogi&) const = default;

    DeclarationRule declaration_rule() const { return declaration_rule_; }
    void set_declaration_rule(DeclarationRule rule) { declaration_rule_ = rule; }
    // The number of moves after which a game that goes on is drawn; 0 for no limit.
    int move_limit() const { return move_limit_; }
    void set_move_limit(int moves) { move_limit_ = moves; }

    const Position& position() const { return position_; }
    Player to_play() const { return position_.to_play(); }
    bool in_check() const { return in_check_; }
    // Moves played since the beginning of the game, also those before the position it was read
    // from.
    int move_count() const { return moves_before_ + plies() - 1; }

    Outcome outcome() const;
    // A mate by checks within three plies, if the move limit leaves room for it.
    std::optional<engine::ForcedMate> forced_mate() const;
    // Whether the mover may declare the game won, under a rule by points.
    bool can_declare_win() const;
    MoveList legal_moves() const;
    void play(Move move);

    std::uint64_t key() const { return position_.key(); }
    // Lines of legal moves that many moves long; only mate ends one.
    std::uint64_t perft(int depth) const;

    // How often the position `back` moves ago had occurred before: 0 the first time.
    int repetitions(int back = 0) const { return past_[past_.size() - 1 - at(back)].repetitions; }
    std::uint64_t key_before(int back) const { return past_[past_.size() - 1 - at(back)].key; }
    // How many positions back the game is known, itself counted.
    int plies() const { return static_cast<int>(past_.size()); }
    // The position `back` moves ago, less than plies().
    Position position_before(int back) const;
    // The last move; {} at the start.
    Move last_move() const { return past_.back().move; }

    // SFEN.
    static Shogi from_text(std::string_view text);
    std::string to_text() const;
    // USI: "7g7f", "8h2b+", "P*5e".
    std::optional<Move> move_from_text(std::string_view text) const;
    std::string move_to_text(Move move) const;

    // engine/shogi/encoding.h
    static std::span<const engine::Encoding<Shogi>> encodings();

   private:
    // A position reached, and how.
    struct Ply {
        std::uint64_t key = 0;
        Move move{};
        Piece captured{};
        std::uint8_t repetitions = 0;
        bool operator==(const Ply&) const = default;
    };
    static std::size_t at(int back) { return static_cast<std::size_t>(back); }
    int earlier_occurrences(std::uint64_t key) const;
    Outcome repetition_outcome() const;
    bool tried() const;

    Position position_;
    std::vector<Ply> past_;
    int moves_before_ = 0, move_limit_ = 0;
    // Moves of each player, the latest ones, that gave check without a pause.
    std::array<int, 2> checks_in_a_row_{};
    Outcome repetition_outcome_ = Outcome::ongoing;
    DeclarationRule declaration_rule_ = DeclarationRule::csa_rule_27;
    bool in_check_ = false;
};

}  // namespace shogi
