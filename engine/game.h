// What search, self-play and the protocols ask of a game.
//
// A game is a value: one game in progress, from its first move on. It is copied, never
// undone; a default-constructed one stands at the start. Its moves are 16-bit codes that
// only the game itself can read, so everything above this folder is free of chess or Go.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace engine {

// Black in Go and shogi, White in chess, moves first.
enum class Player : std::uint8_t { first, second };

constexpr Player operator~(Player p) { return p == Player::first ? Player::second : Player::first; }

enum class Outcome : std::uint8_t { ongoing, draw, first_wins, second_wins };

constexpr Outcome win_for(Player p) {
    return p == Player::first ? Outcome::first_wins : Outcome::second_wins;
}

// The outcome as `p` sees it: 1 for a win, 0 for a draw (or a game still going on), -1 for a loss.
constexpr float value_for(Player p, Outcome outcome) {
    if (outcome == Outcome::draw || outcome == Outcome::ongoing) return 0;
    return outcome == win_for(p) ? 1.0f : -1.0f;
}

struct Move {
    std::uint16_t code = 0;
    constexpr bool operator==(const Move&) const = default;
};

// The legal moves of one position; room for shogi (593 at worst) and Go on 25x25 (626).
// Its constructor leaves the room uninitialised: the list is made once a simulation.
class MoveList {
   public:
    MoveList() {}  // NOLINT(modernize-use-equals-default): `= default` would zero the array
    void push(Move move) { codes_[static_cast<std::size_t>(size_++)] = move.code; }
    void clear() { size_ = 0; }
    int size() const { return size_; }
    bool empty() const { return size_ == 0; }
    Move operator[](int i) const { return {codes_[static_cast<std::size_t>(i)]}; }
    bool contains(Move move) const {
        for (int i = 0; i < size_; ++i)
            if ((*this)[i] == move) return true;
        return false;
    }
    // Keeps, in order, the moves that `keep` is true of.
    template <class Keep>
    void filter(Keep keep) {
        int kept = 0;
        for (int i = 0; i < size_; ++i)
            if (keep((*this)[i])) codes_[static_cast<std::size_t>(kept++)] = (*this)[i].code;
        size_ = kept;
    }

    class Iterator {
       public:
        explicit Iterator(const std::uint16_t* at) : at_(at) {}
        Move operator*() const { return {*at_}; }
        Iterator& operator++() { return ++at_, *this; }
        bool operator!=(const Iterator& other) const { return at_ != other.at_; }

       private:
        const std::uint16_t* at_;
    };
    Iterator begin() const { return Iterator(codes_.data()); }
    Iterator end() const { return Iterator(codes_.data() + size_); }

   private:
    std::array<std::uint16_t, 640> codes_;
    int size_ = 0;
};

template <class G>
concept Game = std::regular<G> && requires(const G game, G next, Move move, std::string_view text) {
    { G::name } -> std::convertible_to<std::string_view>;

    { game.to_play() } -> std::same_as<Player>;
    // By the rules, including those that look at the moves before (repetition, passes).
    { game.outcome() } -> std::same_as<Outcome>;
    // Empty only when the game is over.
    { game.legal_moves() } -> std::same_as<MoveList>;
    // Zobrist key of all that decides which moves are legal now, history aside.
    { game.key() } -> std::same_as<std::uint64_t>;
    // `move` must be legal.
    { next.play(move) } -> std::same_as<void>;

    // A position as its field writes it (FEN, SFEN …); from_text fails with engine::Error.
    { G::from_text(text) } -> std::same_as<G>;
    { game.to_text() } -> std::same_as<std::string>;
    // Empty when the text is no move or the move is not legal here.
    { game.move_from_text(text) } -> std::same_as<std::optional<Move>>;
    { game.move_to_text(move) } -> std::same_as<std::string>;
};

}  // namespace engine
