// What a network says of positions: priors over the moves asked about, and what it expects of the
// end. One call a batch. An evaluator belongs to one thread at a time; a source makes them for
// any. Decorators of the same interface remember answers and turn the board.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "engine/game.h"
#include "search/rollout_player.h"

namespace search {

// AlphaGo's policies: the supervised one, or the one that reinforcement made of it.
enum class Prior : std::uint8_t { supervised, reinforced };
inline constexpr std::array<std::string_view, 2> prior_names = {"supervised", "reinforced"};

// Numbers that some networks tell beside the value, all as the mover sees them; 0 where they do
// not. What each means stands with nn::Graph.
enum class Figure : std::uint8_t {
    lead,
    score,
    score_deviation,
    variance_time,
    winloss_error,
    score_error,
    moves_left,
};
inline constexpr std::size_t figure_count = 7;
// The names of a network's outputs, in the order of the enumerators.
inline constexpr std::array<std::string_view, figure_count> figure_names = {
    "lead",          "score",       "score_deviation", "variance_time",
    "winloss_error", "score_error", "moves_left"};

// All as the player to move sees it.
struct Evaluation {
    std::vector<float> priors;  // one a move, in the order of the question, summing to 1
    float win = 0, loss = 0;    // with `draw` they sum to 1
    float draw = 0;             // or no result; 0 where the network has one value only
    std::array<float, figure_count> figures{};
    // Of every point in [-1, 1], in the game's own order of points; empty where the network has
    // no word on it.
    std::vector<float> owners;

    float value() const { return win - loss; }
    float& operator[](Figure figure) { return figures[static_cast<std::size_t>(figure)]; }
    float operator[](Figure figure) const { return figures[static_cast<std::size_t>(figure)]; }
};

// How the board is turned before the network sees it: 0..7, or one of these.
inline constexpr int random_symmetry = -1, all_symmetries = -2;

template <engine::Game G>
struct Query {
    const G* game = nullptr;
    const engine::MoveList* moves = nullptr;  // legal ones
    int symmetry = 0;
    Evaluation* answer = nullptr;  // overwritten
};

template <engine::Game G>
class Evaluator {
   public:
    virtual ~Evaluator() = default;
    // Fails with engine::Error when the network does not serve the board or yields no numbers.
    virtual void evaluate(std::span<const Query<G>> queries) = 0;
    // Symmetries that may be asked for of such a game: 8, or 1.
    virtual int symmetries(const G& game) const = 0;
    // Of all that an answer depends on, legal moves and symmetry aside.
    virtual std::uint64_t key(const G& game) const = 0;
    // Makes ready for batches of up to `most` such games, so that the first is answered as fast as
    // any. By the thread that will evaluate.
    virtual void warm_up(const G&, int /*most*/) {}
};

// Positions that a worker of the search asks about at once, at most.
inline constexpr int most_batch = 8;

template <engine::Game G>
class EvaluatorSource {
   public:
    virtual ~EvaluatorSource() = default;
    // From any thread.
    virtual std::unique_ptr<Evaluator<G>> make_evaluator() const = 0;
    // One that answers to the last digit, however coarse the search's own.
    virtual std::unique_ptr<Evaluator<G>> make_exact_evaluator() const { return make_evaluator(); }
    // Of a set with more than one policy network, by whose priors.
    virtual std::unique_ptr<Evaluator<G>> make_evaluator_of(Prior) const {
        return make_evaluator();
    }
    // What plays positions out besides: rollouts by the set's own policy, else what the game has.
    virtual std::unique_ptr<RolloutPlayer<G>> make_rollouts() const {
        return std::make_unique<RolloutPlayerBy<G, typename engine::PlayoutsOf<G>::type>>();
    }
    virtual std::string_view name() const = 0;
    // Of its priors, as search makes the best of them.
    virtual float policy_temperature() const { return 1; }
    // Of playing out in the value of a position, as makes the search strongest where the network
    // is asked of every leaf.
    virtual float rollout_share() const { return 0; }
    // Of such games, as many as are best asked about at once: an answer for each then comes
    // soonest, and none of them late.
    virtual int batch(const G&) const { return 1; }
    // Whether its answers have a value; else positions have to be played out.
    virtual bool has_value() const { return true; }
    // Whether it is a set that AlphaGo's search is made for, rollouts and networks blended.
    virtual bool blends() const { return false; }
    // Fails, naming both, when the network does not serve the board of this game.
    virtual void check(const G& game) const = 0;
    // Where the network's policy has this move.
    virtual int policy_index(const G& game, engine::Move move) const = 0;
};

}  // namespace search
