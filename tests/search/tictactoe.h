// Tic-tac-toe: the smallest game that a search can be right or wrong about.
#pragma once

#include <utility>

#include "engine/base/error.h"
#include "engine/game.h"

namespace tictactoe {

using namespace engine;

class TicTacToe {
   public:
    static constexpr std::string_view name = "tictactoe";

    bool operator==(const TicTacToe&) const = default;

    Player to_play() const { return mover_; }
    Outcome outcome() const {
        constexpr std::array<unsigned, 8> lines = {7, 56, 448, 73, 146, 292, 273, 84};
        for (const unsigned line : lines)
            if ((stones_[1] & line) == line) return win_for(~mover_);
        return (stones_[0] | stones_[1]) == 511 ? Outcome::draw : Outcome::ongoing;
    }
    MoveList legal_moves() const {
        MoveList moves;
        if (outcome() != Outcome::ongoing) return moves;
        for (std::uint16_t cell = 0; cell < 9; ++cell)
            if (((stones_[0] | stones_[1]) >> cell & 1) == 0) moves.push({cell});
        return moves;
    }
    std::uint64_t key() const { return stones_[0] * 512u + stones_[1]; }
    void play(Move move) {
        stones_[0] |= 1u << move.code;
        std::swap(stones_[0], stones_[1]);
        mover_ = ~mover_;
    }

    // The cells played so far, as "152".
    static TicTacToe from_text(std::string_view text) {
        TicTacToe game;
        for (std::size_t i = 0; i < text.size(); ++i) {
            const auto move = game.move_from_text(text.substr(i, 1));
            if (!move) fail("no move: {}", text[i]);
            game.play(*move);
        }
        return game;
    }
    std::string to_text() const { return std::to_string(key()); }
    std::optional<Move> move_from_text(std::string_view text) const {
        if (text.size() != 1 || text[0] < '1' || text[0] > '9') return std::nullopt;
        const Move move{static_cast<std::uint16_t>(text[0] - '1')};
        if (!legal_moves().contains(move)) return std::nullopt;
        return move;
    }
    std::string move_to_text(Move move) const { return std::to_string(move.code + 1); }

   private:
    std::array<unsigned, 2> stones_{};  // the mover's, then the opponent's
    Player mover_ = Player::first;
};

static_assert(Game<TicTacToe>);

}  // namespace tictactoe
