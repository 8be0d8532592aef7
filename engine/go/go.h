// Go on boards of 2x2 to 25x25 under any of the rules of go/rules.h: one game in progress.
//
// Black is Player::first. Points are named by (x, y): x counts columns from the left, y rows
// from the bottom, both from 0, so (0, 0) is A1. Passing is always legal; a resigned game is the
// caller's business. After two passes the game is over for search (outcome() scores the board as
// it stands), yet may be played on, as protocols allow.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/encoding.h"
#include "engine/game.h"
#include "engine/go/board.h"
#include "engine/go/rules.h"

namespace go {

using engine::Move;
using engine::MoveList;
using engine::Outcome;
using engine::Player;

struct Point {
    int x = 0, y = 0;
    bool operator==(const Point&) const = default;
};

class Rollouts;

class Go {
   public:
    using Rollouts = go::Rollouts;  // engine/go/rollouts.h

    static constexpr std::string_view name = "go";
    static constexpr Move pass{0};
    // How networks see it; the first row is what our own are trained with.
    static std::span<const engine::Encoding<Go>> encodings();
    static constexpr int remembered = 8;  // positions that networks may look back on, this included

    explicit Go(int size = 19, Komi komi = {}, const Rules& rules = {});

    bool operator==(const Go& other) const = default;

    int size() const { return board_.size(); }
    Komi komi() const { return komi_; }
    const Rules& rules() const { return rules_; }
    // Both keep the stones and the history.
    void set_komi(Komi komi) { komi_ = komi; }
    void set_rules(const Rules& rules) { rules_ = rules; }

    Player to_play() const { return to_play_; }
    // As if the other player had passed without its being counted: lifts a simple ko.
    void set_to_play(Player player);
    const Board& board() const { return board_; }
    std::optional<Player> at(Point point) const;
    Move move_at(Point point) const;                 // whether legal or not
    std::optional<Point> point_of(Move move) const;  // empty for a pass
    std::optional<Point> ko_point() const;           // where a simple ko forbids the mover to take
    // Moves since the start or the last set-up, passes counted.
    int move_count() const { return move_count_; }
    // Stones that Black has played since then beyond White's, passes not counted.
    int stone_surplus() const { return stone_surplus_; }
    // Prisoners that `player` took, those of an opponent's suicide among them.
    int captured_by(Player player) const { return captured_[side(player)]; }
    int consecutive_passes() const { return passes_; }
    // Of one side, as games usually go: some 0.7 moves a point in all, never fewer than a sixth of
    // the points, since the end of a game is slow to come.
    int moves_to_come() const {
        const int points = size() * size();
        return std::max((points * 7 / 10 - move_count_) / 2, points / 6 + 4);
    }

    // The stones as they stood `ago` moves earlier, 0 <= ago < remembered, no further back than
    // the start or the last set-up: then empty.
    const Stones& stones_before(int ago) const;
    // The move made `ago` moves earlier (0: the last one); empty where stones_before(ago + 1) is.
    std::optional<Move> move_before(int ago) const;

    bool legal(Move move) const;
    // Empty when legal, else why not: "occupied", "ko", "superko", "suicide".
    std::string_view why_illegal(Move move) const;
    MoveList legal_moves() const;
    void play(Move move);
    // Does the move fill a one-point eye of the mover's own: all neighbours own, and at most one
    // diagonal (none at the edge) the opponent's?
    bool fills_own_eye(Move move) const;

    // Puts or takes a stone outside the play (AB, AW, AE, handicap); captures nothing and starts
    // the history anew.
    void set_up(Point point, std::optional<Player> stone);
    // Takes a stone that the players agree is dead, as the opponent's prisoner; none, no effect.
    void take_dead(Point point);
    // False after a set-up that left a chain without liberty.
    bool every_chain_has_liberty() const;
    // Stones by which White's bonus is counted under the rules in force.
    int handicap() const { return handicap_; }
    void set_handicap(int stones) { handicap_ = stones; }
    int white_bonus() const;  // the points those rules give

    Outcome outcome() const;
    // Third occurrence of a position under simple ko: the game has no result (a draw in search).
    bool no_result() const { return no_result_; }
    // Whether a game may end so under these rules, as KataGo's networks are told.
    bool can_end_without_result() const {
        return rules_.ko == Ko::simple || rules_.scoring == Scoring::territory;
    }

    std::uint64_t key() const;

    // One line: rows from the top as in FEN (numbers for empty points, X black, O white), the
    // mover (b or w), the point a simple ko forbids or "-", prisoners of Black:White, komi, rules,
    // handicap. What is left out at the end is as in a new game.
    static Go from_text(std::string_view text);
    std::string to_text() const;
    // Vertices: "A1" … "Z25" without I, any case, or "pass".
    std::optional<Move> move_from_text(std::string_view text) const;
    std::string move_to_text(Move move) const;

   private:
    static std::size_t side(Player player) { return player == Player::first ? 0 : 1; }
    static constexpr std::uint64_t mover_bit = 1;

    int index(Point point) const { return board_.index(point.x, point.y); }
    bool repeats(int at) const;
    std::uint64_t position_key(std::uint64_t stones, Player mover) const;
    void remember(Move move);
    void forget();
    void play_stone(int at);

    Board board_;
    Player to_play_ = Player::first;
    std::uint8_t passes_ = 0;
    bool no_result_ = false;
    std::uint16_t ko_ = 0;
    std::int32_t move_count_ = 0;
    std::int32_t stone_surplus_ = 0;
    std::int32_t handicap_ = 0;
    std::array<std::int32_t, 2> captured_{};
    Komi komi_;
    Rules rules_;

    // History. Keys of all positions so far, the present one last: the stones', with the mover in
    // the lowest bit. A stone can recreate a position only where one like it once stood.
    std::vector<std::uint64_t> positions_;
    Stones taken_off_;
    std::array<Stones, remembered> recent_;      // by move_count_ % remembered
    std::array<Move, remembered> last_moves_{};  // that led to them
};

// "A1" … "Z25", columns without I.
std::string vertex(Point point);
// Any case; empty when it is no point of the board (a pass included).
std::optional<Point> point_from_vertex(std::string_view text, int size);

// The board with coordinates, rules, komi, prisoners and the mover, as showboard prints it.
std::string diagram(const Go& game);

// GTP's fixed handicap points, in GTP's order. Fails, naming the range, where the size or the
// number has none.
std::vector<Point> fixed_handicap(int size, int stones);
int most_fixed_handicap(int size);
// Where a player may put `stones` of free handicap: the fixed points if there are so many, else
// these and then others, spread out. Fails unless 2 <= stones < size * size.
std::vector<Point> free_handicap(int size, int stones);

}  // namespace go
