// Our rules, watching one game of a match. Everything is text in the game's own notation, so that
// whoever plays a match names no game.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/game.h"

namespace selfplay {

// How a game stands. `reason` is empty while it goes on.
struct Verdict {
    engine::Outcome outcome = engine::Outcome::ongoing;
    std::string reason;  // "score", "rules", "no result"
    std::string score;   // in games with points: "B+3.5"
};

// What became of a move: as the game itself writes it, or why it is not legal.
struct Played {
    std::string move, objection;
};

class Referee {
   public:
    virtual ~Referee() = default;

    virtual engine::Player to_play() const = 0;
    virtual Played play(std::string_view move) = 0;
    // The legal moves among which a random opening chooses; empty when the game is over.
    virtual std::vector<std::string> opening_moves() const = 0;
    virtual Verdict verdict() const = 0;

    // Whether the players must now be asked for dead stones, which remove() then takes off. Asked
    // once, when verdict() first tells an outcome.
    virtual bool wants_dead_stones() const { return false; }
    virtual void remove(std::span<const std::string>) {}
    // Whether the mover may declare the game won (shogi's impasse).
    virtual bool may_claim_win() const { return false; }
};

// How moves of a game are read beyond its own notation, and how its endings are called. A game
// with more to say specialises it.
template <engine::Game G>
struct Manner {
    static std::optional<engine::Move> read(const G& game, std::string_view text) {
        return game.move_from_text(text);
    }
    // Of a game that is over.
    static std::string ending(const G&) { return "rules"; }
    static bool may_claim_win(const G&) { return false; }
};

// Any game, by the concept and its manner alone.
template <engine::Game G>
class GameReferee final : public Referee {
   public:
    explicit GameReferee(G start) : game_(std::move(start)) {}

    engine::Player to_play() const override { return game_.to_play(); }

    Played play(std::string_view text) override {
        const auto move = Manner<G>::read(game_, text);
        if (!move) return {{}, "not a legal move"};
        auto written = game_.move_to_text(*move);
        game_.play(*move);
        return {std::move(written), {}};
    }

    std::vector<std::string> opening_moves() const override {
        std::vector<std::string> moves;
        if (game_.outcome() != engine::Outcome::ongoing) return moves;
        for (const auto move : game_.legal_moves()) moves.push_back(game_.move_to_text(move));
        return moves;
    }

    Verdict verdict() const override {
        const auto outcome = game_.outcome();
        if (outcome == engine::Outcome::ongoing) return {};
        return {outcome, Manner<G>::ending(game_), {}};
    }

    bool may_claim_win() const override { return Manner<G>::may_claim_win(game_); }

   private:
    G game_;
};

}  // namespace selfplay
