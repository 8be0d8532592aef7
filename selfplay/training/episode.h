// One self-play game in progress: its tree, its random numbers, its record so far. It is driven
// from outside, one network answer at a time: gather() walks on (playing moves as searches are
// done) until it needs an answer, absorb() takes it. Belongs to one thread.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "search/tree_search.h"
#include "selfplay/records/game.h"
#include "selfplay/training/chance.h"
#include "selfplay/training/terms.h"

namespace selfplay::training {

template <engine::Encoded G>
class Episode {
   public:
    // `resign_below`: the value at which a side gives up, -1 for never.
    Episode(const ActorSettings& settings, std::uint64_t seed, float resign_below)
        : settings_(settings),
          random_(seed),
          plays_on_(happens(random_, settings.play_on_share) || resign_below <= -1),
          resign_below_(plays_on_ ? -1 : resign_below),
          start_(first_position<G>(settings, random_)),
          search_(params_for(settings, start_), true) {
        search_.set_root(start_);
        if (happens(random_, settings.opening_share))
            opening_ = 1 + random_.below(2 * settings.opening_moves - 1);
        record_.game = G::name;
        record_.start = start_.to_text();
        begin_turn();
    }

    const G& position() const { return search_.root(); }
    int board() const { return board_of(start_); }
    // Moves of both so far, and how many of them taught the policy.
    std::size_t plies() const { return record_.turns.size(); }
    std::size_t taught() const { return taught_; }
    // Whether it is played to its end whatever the searches say.
    bool plays_on() const { return plays_on_; }
    // Take effect with the next turn.
    void set_simulations(int full, int fast) {
        settings_.simulations = full;
        settings_.fast_simulations = fast;
    }

    // Walks to a leaf that the network must judge; false: the game is over, and its record ready.
    bool gather(search::Leaf<G>& leaf) {
        for (;;) {
            if (root().expanded()) {
                if (!prepared_) prepare();
                if (done_ >= target_) {
                    if (!play()) return false;
                    continue;
                }
            }
            switch (search_.gather(leaf, false)) {
                case search::Gathered::leaf:
                    return true;
                case search::Gathered::full:
                    search_.flip();
                    break;
                default:  // one descent at a time: no leaf is in other hands
                    ++done_;
            }
        }
    }

    void absorb(search::Leaf<G>& leaf) {
        if (leaf.path.size() > 1) ++done_;
        if (!search_.absorb(leaf)) search_.flip();
    }

    // Of a game that is over; all but the steps of training.
    records::Game take_record() { return std::move(record_); }

   private:
    enum class Kind : std::uint8_t { opening, fast, full };

    static search::SearchParams params_for(const ActorSettings& settings, const G& start) {
        search::SearchParams params;
        params.cpuct = settings.cpuct;
        params.fpu_reduction = settings.fpu_reduction;
        params.root_fpu_reduction = 0;
        // Two halves, each with room for this search and what is kept of the one before.
        const auto node = sizeof(search::Node) +
                          sizeof(search::Edge) * static_cast<std::size_t>(typical_moves(start));
        const auto bytes = 4 * node * static_cast<std::size_t>(settings.simulations);
        params.memory_mib = static_cast<int>(1 + (bytes >> 20));
        return params;
    }

    const search::Node& root() const { return search_.tree()[search_.tree().root()]; }
    std::span<const search::Edge> edges() const {
        return search_.tree().edges(search_.tree().root());
    }

    void begin_turn() {
        prepared_ = false;
        done_ = 0;
        if (plies() < static_cast<std::size_t>(opening_)) {
            kind_ = Kind::opening;
            target_ = 0;
        } else {
            kind_ = happens(random_, settings_.full_share) ? Kind::full : Kind::fast;
            target_ = kind_ == Kind::full ? settings_.simulations : settings_.fast_simulations;
        }
    }

    // Once the root has its moves.
    void prepare() {
        prepared_ = true;
        if (edges().size() == 1) target_ = 0;
        // What is left of the search before counts towards a fast one.
        if (kind_ == Kind::fast) done_ += static_cast<int>(root().visits) - 1;
    }

    // Makes a move; false when the game is over.
    bool play() {
        const float value = -root().mean();
        if (gives_up(value)) return finish_resigned(), false;
        count_visits();
        const auto move = choose(value);
        search_.advance(move);
        const auto& game = position();
        const bool over = game.outcome() != engine::Outcome::ongoing;
        if (!over && plies() < static_cast<std::size_t>(move_limit(settings_, start_)))
            return begin_turn(), true;
        record_.ending = over ? records::Ending::rules : records::Ending::move_limit;
        write_result(game, record_);
        return false;
    }

    bool gives_up(float value) {
        if (kind_ == Kind::opening) return false;
        int& low = low_turns_[position().to_play() == engine::Player::first ? 0 : 1];
        low = value < resign_below_ ? low + 1 : 0;
        return low >= settings_.resign_turns;
    }

    void finish_resigned() {
        record_.ending = records::Ending::resigned;
        record_.outcome = engine::win_for(~position().to_play());
    }

    void count_visits() {
        moves_.clear();
        weights_.clear();
        for (const auto& edge : edges()) {
            const auto child = search_.tree().child(search_.tree().root(), edge);
            moves_.push_back(edge.move);
            weights_.push_back(
                child == search::no_node ? 0 : static_cast<float>(search_.tree()[child].visits));
        }
    }

    // The move to play, recorded with what it teaches.
    engine::Move choose(float value) {
        const auto simulations = static_cast<std::uint32_t>(target_);
        float sum = 0;
        for (const float weight : weights_) sum += weight;
        if (kind_ == Kind::opening || sum == 0) {
            const auto move = moves_[draw_by_priors()];
            record_.add(move, value, simulations, {}, {});
            return move;
        }
        const auto move = moves_[draw_by_visits()];
        for (float& weight : weights_) weight /= sum;
        const bool teaches = kind_ == Kind::full && target_ > 0;
        taught_ += teaches;
        record_.add(
            move, value, simulations,
            teaches ? std::span<const engine::Move>(moves_) : std::span<const engine::Move>(),
            weights_);
        return move;
    }

    std::size_t draw_by_priors() {
        chances_.clear();
        for (const auto& edge : edges()) chances_.push_back(edge.prior());
        return draw(random_, chances_);
    }

    std::size_t draw_by_visits() {
        const auto most = std::max_element(weights_.begin(), weights_.end());
        const float temperature = plies() < static_cast<std::size_t>(settings_.temperature_moves)
                                      ? settings_.temperature
                                      : settings_.late_temperature;
        if (temperature < 0.01f) return static_cast<std::size_t>(most - weights_.begin());
        chances_.clear();
        for (const float weight : weights_)
            chances_.push_back(std::pow(weight / *most, 1 / temperature));
        return draw(random_, chances_);
    }

    ActorSettings settings_;
    engine::Random random_;
    bool plays_on_;
    float resign_below_;
    G start_;
    search::TreeSearch<G> search_;
    records::Game record_;

    // The turn.
    Kind kind_ = Kind::fast;
    int target_ = 0, done_ = 0;  // simulations beyond the root's own
    bool prepared_ = false;

    int opening_ = 0;  // moves to be drawn from the policy
    std::size_t taught_ = 0;
    std::array<int, 2> low_turns_{};
    std::vector<engine::Move> moves_;  // at the root, with their visits or shares
    std::vector<float> weights_, chances_;
};

}  // namespace selfplay::training
