// The evaluator at the bottom: positions to tensors by the game's encoding, an executor, outputs
// to answers. It does what each query says: symmetries are chosen and averaged elsewhere. Of a
// network without a policy the priors are empty, of one without a value it is 0.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/encoding.h"
#include "nn/executor.h"
#include "search/answer.h"
#include "search/evaluator.h"
#include "search/network.h"

namespace search {

template <engine::Encoded G>
class NetworkEvaluator final : public Evaluator<G> {
   public:
    explicit NetworkEvaluator(std::shared_ptr<const Network> network)
        : network_(std::move(network)),
          encoding_(engine::find_encoding<G>(network_->graph().facts.encoding)),
          outputs_(network_->graph()) {}

    void evaluate(std::span<const Query<G>> queries) override {
        // Positions of one board size at a time.
        while (!queries.empty()) {
            const auto shape = encoding_.shape(*queries[0].game);
            const auto differs = [&](const Query<G>& query) {
                return encoding_.shape(*query.game) != shape;
            };
            const auto end = std::find_if(queries.begin(), queries.end(), differs);
            const auto count = static_cast<std::size_t>(end - queries.begin());
            evaluate_alike(queries.first(count), shape);
            queries = queries.subspan(count);
        }
    }

    int symmetries(const G& game) const override { return encoding_.shape(game).symmetries; }
    std::uint64_t key(const G& game) const override { return encoding_.key(game); }

    void warm_up(const G& game, int most) override {
        const auto shape = encoding_.shape(game);
        for (int count = most; count > 0; --count) {
            prepare(static_cast<std::size_t>(count), shape);
            executor_->run({count, shape.height, inputs_, results_});
        }
    }

   private:
    void evaluate_alike(std::span<const Query<G>> queries, const engine::EncodingShape& shape) {
        prepare(queries.size(), shape);
        for (std::size_t i = 0; i < queries.size(); ++i) encode(queries[i], i);
        executor_->run({static_cast<int>(queries.size()), shape.height, inputs_, results_});
        for (std::size_t i = 0; i < queries.size(); ++i) decode(queries[i], i);
    }

    void prepare(std::size_t count, const engine::EncodingShape& shape) {
        if (!executor_ || shape != shape_) {
            shape_ = shape;
            executor_ = network_->make_executor(shape.height);
            sizes_ = network_->output_sizes(shape.height);
            most_ = 0;
        }
        const auto globals = static_cast<std::size_t>(shape.globals);
        if (count > most_) {
            most_ = count;
            planes_.resize(count * shape.planes_size());
            turned_.resize(shape.planes_size());
            globals_.resize(count * globals);
            numbers_.resize(sizes_.size());
            for (std::size_t i = 0; i < sizes_.size(); ++i) numbers_[i].resize(count * sizes_[i]);
        }
        inputs_.clear();
        inputs_.push_back(std::span(planes_).first(count * shape.planes_size()));
        if (network_->input_count() > 1)
            inputs_.push_back(std::span(globals_).first(count * globals));
        results_.clear();
        for (std::size_t i = 0; i < sizes_.size(); ++i)
            results_.push_back(std::span(numbers_[i]).first(count * sizes_[i]));
    }

    void encode(const Query<G>& query, std::size_t index) {
        const auto planes =
            std::span(planes_).subspan(index * shape_.planes_size(), shape_.planes_size());
        const auto globals = static_cast<std::size_t>(shape_.globals);
        const auto numbers = std::span(globals_).subspan(index * globals, globals);
        if (query.symmetry <= 0) return encoding_.write(*query.game, planes, numbers);
        encoding_.write(*query.game, turned_, numbers);
        turn_planes(turned_, static_cast<std::size_t>(shape_.width), query.symmetry, planes);
    }

    void decode(const Query<G>& query, std::size_t index) {
        Evaluation& to = *query.answer;
        const G& game = *query.game;
        const bool sound = read_policy(query, index) && read_value(game, index, to);
        if (!sound)
            engine::fail("the network {} yields what is no number", network_->graph().facts.name);
        for (std::size_t i = 0; i < figure_count; ++i)
            to.figures[i] = outputs_.figures[i] ? result(*outputs_.figures[i], index)[0] : 0;
        // What a game without result would score counts for nothing.
        for (const auto figure : {Figure::lead, Figure::score}) to[figure] *= 1 - to.draw;
        read_owners(query, index);
    }

    std::span<const float> result(std::size_t output, std::size_t index) const {
        return std::span(numbers_[output]).subspan(index * sizes_[output], sizes_[output]);
    }

    // Where the turned board has what the encoding has at `index`.
    std::size_t turned_index(std::size_t index, int symmetry) {
        if (symmetry <= 0 || index >= shape_.points()) return index;
        return turned_back(symmetry)[index];
    }
    const std::vector<std::size_t>& turned_back(int symmetry) {
        auto& table = turned_back_[static_cast<std::size_t>(symmetry)];
        if (table.size() == shape_.points()) return table;
        table.resize(shape_.points());
        for (std::size_t point = 0; point < table.size(); ++point)
            table[turned_point(point, static_cast<std::size_t>(shape_.width), symmetry)] = point;
        return table;
    }

    bool read_policy(const Query<G>& query, std::size_t index) {
        auto& priors = query.answer->priors;
        priors.clear();
        if (!outputs_.policy) return true;
        const auto logits = result(*outputs_.policy, index);
        for (const engine::Move move : *query.moves) {
            const int at = encoding_.policy_index(*query.game, move);
            priors.push_back(logits[turned_index(static_cast<std::size_t>(at), query.symmetry)]);
        }
        return softmax(priors);
    }

    bool read_value(const G& game, std::size_t index, Evaluation& to) const {
        if (!outputs_.wdl && !outputs_.value) return set_value(0, to);
        const bool sound = outputs_.wdl
                               ? set_outcomes(result(*outputs_.wdl, index), has_draws(game), to)
                               : set_value(result(*outputs_.value, index)[0], to);
        if (encoding_.value_of_first && game.to_play() == engine::Player::second)
            exchange_players(to);
        return sound;
    }

    static bool has_draws(const G& game) {
        if constexpr (requires { game.can_end_without_result(); })
            return game.can_end_without_result();
        return true;
    }

    void read_owners(const Query<G>& query, std::size_t index) {
        auto& owners = query.answer->owners;
        owners.clear();
        if constexpr (requires { query.game->move_at({0, 0}); }) {
            if (!outputs_.ownership) return;
            const auto numbers = result(*outputs_.ownership, index);
            for (int y = 0; y < shape_.height; ++y)
                for (int x = 0; x < shape_.width; ++x) {
                    const int at = encoding_.policy_index(*query.game, query.game->move_at({x, y}));
                    owners.push_back(
                        numbers[turned_index(static_cast<std::size_t>(at), query.symmetry)]);
                }
        }
    }

    std::shared_ptr<const Network> network_;
    const engine::Encoding<G>& encoding_;
    OutputMap outputs_;
    engine::EncodingShape shape_{};
    std::unique_ptr<nn::Executor> executor_;  // for the board of shape_
    std::size_t most_ = 0;                    // positions that there is room for
    std::vector<std::size_t> sizes_;          // of the outputs, a position
    std::vector<float> planes_, turned_, globals_;
    std::vector<std::vector<float>> numbers_;
    std::vector<std::span<const float>> inputs_;
    std::vector<std::span<float>> results_;
    std::array<std::vector<std::size_t>, 8> turned_back_;
};

// A network that plays G.
template <engine::Encoded G>
class NetworkSource final : public EvaluatorSource<G> {
   public:
    // Fails with engine::Error when the network is for another game.
    // `exact` is the same network in fp32, where that is at hand.
    explicit NetworkSource(std::shared_ptr<const Network> network,
                           std::shared_ptr<const Network> exact = nullptr)
        : network_(std::move(network)), exact_(exact ? std::move(exact) : network_) {
        const auto& facts = network_->graph().facts;
        if (facts.game != G::name)
            engine::fail("the network {} plays {}, not {}", facts.name, facts.game, G::name);
        encoding_ = &engine::find_encoding<G>(facts.encoding);
        OutputMap(network_->graph()).check(facts.name);
    }

    std::unique_ptr<Evaluator<G>> make_evaluator() const override {
        return std::make_unique<NetworkEvaluator<G>>(network_);
    }
    std::unique_ptr<Evaluator<G>> make_exact_evaluator() const override {
        return std::make_unique<NetworkEvaluator<G>>(exact_);
    }
    const std::shared_ptr<const Network>& network() const { return network_; }
    // In which the search runs it.
    nn::Precision precision() const { return network_->precision(); }
    std::string_view name() const override { return network_->graph().facts.name; }
    float policy_temperature() const override { return ours() ? suited().temperature : 1; }
    float rollout_share() const override { return ours() ? suited().rollout_share : 0; }
    // Small boards leave the kernels half empty when they come alone; beyond so many points nothing
    // is gained, and so many operations keep a search that is told to stop for 10 ms or more.
    int batch(const G& game) const override {
        constexpr double most_points = 640, most_operations = 4e9;
        const auto shape = encoding_->shape(game);
        const auto operations = flop_count(network_->graph(), shape.height);
        const double most = std::min(most_points / static_cast<double>(shape.points()),
                                     most_operations / static_cast<double>(operations));
        return static_cast<int>(std::clamp<double>(most, 1, most_batch));
    }

    void check(const G& game) const override {
        const auto& facts = network_->graph().facts;
        const auto shape = encoding_->shape(game);
        if (facts.board != 0 && facts.board != shape.height)
            engine::fail("the network {} is for boards of {}x{}, not {}x{}", facts.name,
                         facts.board, facts.board, shape.height, shape.width);
        network_->check(shape.planes, shape.globals, shape.policy_size, shape.height);
    }

    int policy_index(const G& game, engine::Move move) const override {
        return encoding_->policy_index(game, move);
    }

   private:
    // What the search makes the best of our training's networks by, from thousands of games where
    // others had millions: they know openings better than who is alive at the end in Go, and what
    // hangs in chess and shogi. By matches that weights/training.md has.
    struct Suited {
        float temperature, rollout_share;
    };
    static constexpr Suited suited() {
        if constexpr (G::name == "go") return {1, 0.4f};
        if constexpr (G::name == "chess") return {1.7f, 0.5f};
        if constexpr (G::name == "shogi") return {1.5f, 0.5f};
        return {1, 0};
    }
    bool ours() const { return network_->graph().facts.source.starts_with("sanban "); }

    std::shared_ptr<const Network> network_, exact_;
    const engine::Encoding<G>* encoding_ = nullptr;
};

}  // namespace search
