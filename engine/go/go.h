// Go on boards of 2x2 to 25x25 under any of the rules of go/rules.h: one game in progress.
//
// Black is Player::first. Points are named by (x, y): x counts columns from the left, y rows
// from the bottom, both from 0, so (0, 0) is A1. Passing is always legal; a resigned game is the
// caller's business. After two passes the game is over for search (outcome() scores the board as
// it stands), yet may be played on, as protocols allow.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/game.h"
#include "engine/go/board.h"
#include "engine/go/rules.h"

namespace go {

using engine::Move;
using engine::MoveList;
using engine::Outcome;
using engine::Player;

inline constexpr int min_size = 2, max_size = 25;

struct Point {
    int x = 0, y = 0;
    bool operator==(const Point&) const = default;
};

class Go {
   public:
    static constexpr std::string_view name = "go";
    static constexpr Move pass{0};

    explicit Go(int size = 19, Komi komi = {}, const Rules& rules = {});

    bool operator==(const Go& other) const;

    int size() const;
    Komi komi() const;
    const Rules& rules() const;
    // Both keep the stones and the history.
    void set_komi(Komi komi);
    void set_rules(const Rules& rules);

    Player to_play() const;
    void set_to_play(Player player);
    std::optional<Player> at(Point point) const;
    Move move_at(Point point) const;                 // whether legal or not
    std::optional<Point> point_of(Move move) const;  // empty for a pass
    // Moves since the start or the last set-up, passes counted.
    int move_count() const;
    int captured_by(Player player) const;  // prisoners that `player` took
    int consecutive_passes() const;

    bool legal(Move move) const;
    // Empty when legal, else why not: "occupied", "ko", "superko", "suicide".
    std::string_view why_illegal(Move move) const;
    MoveList legal_moves() const;
    void play(Move move);

    // Puts or takes a stone outside the play (AB, AW, AE, handicap); captures nothing and starts
    // the history anew.
    void set_up(Point point, std::optional<Player> stone);
    // Stones by which White's bonus is counted under the rules in force.
    int handicap() const;
    void set_handicap(int stones);

    Outcome outcome() const;
    // Third occurrence of a position under simple ko: the game has no result (a draw in search).
    bool no_result() const;

    std::uint64_t key() const;

    // One line: rows from the top as in FEN (digits for empty points, X black, O white), the mover,
    // size, komi, rules.
    static Go from_text(std::string_view text);
    std::string to_text() const;
    // Vertices: "A1" … "Z25" without I, any case, or "pass".
    std::optional<Move> move_from_text(std::string_view text) const;
    std::string move_to_text(Move move) const;

   private:
    // … board, rules, keys of the positions so far
};

std::string vertex(Point point);
std::optional<Point> point_from_vertex(std::string_view text, int size);

// The board with coordinates, rules, komi, prisoners and the mover, as showboard prints it.
std::string diagram(const Go& game);

// GTP's fixed handicap points, in GTP's order. Fails, naming the range, where the size or the
// number has none.
std::vector<Point> fixed_handicap(int size, int stones);
int most_fixed_handicap(int size);

}  // namespace go
