// One self-play game in progress: its tree, its random numbers, its record so far. It is driven
// from outside, one network answer at a time: gather() walks on (playing moves as searches are
// done) until it needs an answer, absorb() takes it. Belongs to one thread.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "search/gumbel.h"
#include "search/temperature.h"
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
            switch (search_.gather(leaf, false, first_move())) {
                case search::Gathered::leaf:
                    first_.reset();
                    return true;
                case search::Gathered::full:
                    search_.flip();
                    break;
                default:  // one descent at a time: no leaf is in other hands
                    first_.reset();
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
        params.policy_temperature = 1;  // what search makes of the priors is what they learn
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
        if (target_ == 0) return;
        if (settings_.exploration == Exploration::gumbel)
            gumbel_.emplace(search_.tree(), search_.filter(), target_, gumbel_params(), random_);
        else if (kind_ == Kind::full)
            search_.mix_root_noise(random_, settings_.noise_share, settings_.noise_alpha);
        else  // what is left of the search before counts
            done_ += static_cast<int>(root().visits) - 1;
    }

    search::GumbelParams gumbel_params() const {
        search::GumbelParams params;
        params.considered = settings_.candidates;
        params.scale = settings_.gumbel_scale;
        return params;
    }

    // That the descent must begin with; the same until the descent comes off.
    std::optional<engine::Move> first_move() {
        if (gumbel_ && !first_) first_ = gumbel_->next();
        return first_;
    }

    // Makes a move; false when the game is over.
    bool play() {
        const float value = -root().mean();
        if (gives_up(value)) return finish_resigned(), false;
        const auto move = choose(value);
        gumbel_.reset();
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

    // The move to play, recorded with what it teaches.
    engine::Move choose(float value) {
        if (kind_ == Kind::opening || target_ == 0) return play_prior(value);
        const auto move = gumbel_ ? gumbel_->best() : draw_by_visits();
        moves_.clear();
        if (kind_ == Kind::full) {
            ++taught_;
            for (const auto& edge : edges()) moves_.push_back(edge.move);
        }
        record_.add(move, value, static_cast<std::uint32_t>(target_), moves_, policy());
        record_.turns.back().draws = root().draws.value();
        return move;
    }

    // Drawn from the policy, without a search.
    engine::Move play_prior(float value) {
        chances_.clear();
        for (const auto& edge : edges()) chances_.push_back(edge.prior());
        const auto move = edges()[draw(random_, chances_)].move;
        record_.add(move, value, 0, {}, {});
        return move;
    }

    engine::Move draw_by_visits() {
        visits_.clear();
        for (const auto& edge : edges()) {
            const auto child = search_.tree().child(search_.tree().root(), edge);
            visits_.push_back(child == search::no_node ? 0 : search_.tree()[child].visits.load());
        }
        const bool early = plies() < static_cast<std::size_t>(settings_.temperature_moves);
        const float temperature = early ? settings_.temperature : settings_.late_temperature;
        return edges()[search::draw_by_count(visits_, temperature, random_)].move;
    }

    // What the search would have the policy be.
    std::vector<float> policy() const {
        if (gumbel_)
            return search::improved_policy(search_.tree(), search_.filter(), gumbel_params());
        std::uint64_t sum = 0;
        for (const auto visits : visits_) sum += visits;
        std::vector<float> shares;
        for (const auto visits : visits_)
            shares.push_back(static_cast<float>(visits) / static_cast<float>(sum));
        return shares;
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
    std::optional<search::GumbelRoot> gumbel_;  // of a search that goes by it
    std::optional<engine::Move> first_;

    int opening_ = 0;  // moves to be drawn from the policy
    std::size_t taught_ = 0;
    std::array<int, 2> low_turns_{};
    std::vector<engine::Move> moves_;    // of the policy target
    std::vector<std::uint64_t> visits_;  // of the root's edges
    std::vector<float> chances_;
};

}  // namespace selfplay::training
