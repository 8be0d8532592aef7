// Go positions from diagrams and games from lists of vertices, for tests.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/go/go.h"

namespace go {

// Rows from the top: X black, O white, anything else empty; blanks do not count.
inline Go position(const std::vector<std::string>& rows, const Rules& rules = {}, double komi = 0,
                   Player to_play = Player::first) {
    const auto size = static_cast<int>(rows.size());
    Go game(size, Komi::from_points(komi), rules);
    for (int y = 0; y < size; ++y) {
        int x = 0;
        for (const char c : rows[static_cast<std::size_t>(size - 1 - y)]) {
            if (c == ' ') continue;
            if (c == 'X') game.set_up({x, y}, Player::first);
            if (c == 'O') game.set_up({x, y}, Player::second);
            ++x;
        }
        if (x != size) engine::fail("bad diagram row {}", size - y);
    }
    game.set_to_play(to_play);
    return game;
}

inline std::vector<std::string> rows_of(const Go& game) {
    std::vector<std::string> rows;
    for (int y = game.size() - 1; y >= 0; --y) {
        std::string row;
        for (int x = 0; x < game.size(); ++x) {
            const auto stone = game.at({x, y});
            row += !stone ? '.' : *stone == Player::first ? 'X' : 'O';
        }
        rows.push_back(row);
    }
    return rows;
}

inline Move at(const Go& game, std::string_view vertex) {
    return vertex == "pass" ? Go::pass
                            : game.move_at(point_from_vertex(vertex, game.size()).value());
}

// Plays alternately; fails at the first illegal move.
inline void play(Go& game, const std::string& vertices) {
    std::istringstream words(vertices);
    for (std::string word; words >> word;) {
        const auto move = game.move_from_text(word);
        if (!move) engine::fail("illegal move {}: {}", word, game.why_illegal(at(game, word)));
        game.play(*move);
    }
}

inline std::string_view why_illegal(const Go& game, std::string_view vertex) {
    return game.why_illegal(at(game, vertex));
}

inline Rules rules_with(Ko ko, bool suicide = false) {
    Rules rules;
    rules.ko = ko;
    rules.suicide = suicide;
    return rules;
}

}  // namespace go
