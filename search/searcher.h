// The search that a protocol talks to: a tree, workers on their own threads, and the limits
// of a think. One owner calls everything here from one thread; only the callbacks come from
// another.
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/games.h"
#include "search/alphago_leaf.h"
#include "search/analysis.h"
#include "search/cached_evaluator.h"
#include "search/clock.h"
#include "search/crew.h"
#include "search/limits.h"
#include "search/network_leaf.h"
#include "search/params.h"
#include "search/symmetry_evaluator.h"
#include "search/temperature.h"
#include "search/tree_search.h"
#include "search/worker.h"

namespace search {

template <engine::Game G>
class Searcher {
   public:
    using Report = std::function<void(const Analysis&)>;

    // Fails with engine::Error when the system grants no memory for the tree.
    explicit Searcher(const SearchParams& params) : given_(params) { rebuild(params); }
    Searcher(const Searcher&) = delete;
    Searcher& operator=(const Searcher&) = delete;
    ~Searcher() { stop(); }

    // A changed memory budget forgets the tree; changed threads or seed start new workers. Fails,
    // all being as before, when the search would go by values of a network that has none.
    void set_params(const SearchParams& params);
    const SearchParams& params() const { return given_; }

    // Searches with this network from now on, with games played out when it is none; forgets the
    // tree. Fails, all being as before, when the network does not serve the present board, or has
    // no value where the search goes by one.
    void set_network(std::shared_ptr<const EvaluatorSource<G>> network);
    bool has_network() const { return network_ != nullptr; }
    const std::shared_ptr<const EvaluatorSource<G>>& network() const { return network_; }
    // Has every worker make its network ready for the present position's board. Blocks.
    void warm_up();
    // Fails when the network, if there is one, does not serve the board of this game.
    void check(const G& game) const {
        if (uses_network()) network_->check(game);
    }

    const G& position() const { return search_->root(); }
    // The position to think about. Keeps the part of the tree that the position shares when it
    // comes after the present one by at most two moves of the tree; else starts anew.
    void set_position(const G& root);
    // Plays a legal move in the present position and keeps what the tree has below it.
    void advance(Move move);
    // Forgets the tree and starts the random numbers anew: what follows is as in a new Searcher.
    void clear();

    // Returns at once. `report` and `done` (either may be empty) are called from a thread of the
    // search; `done` exactly once a think, after which the search is idle. While it runs only
    // stop(), interrupt(), ponder_hit(), thinking() and analysis() may be called; a callback may
    // call no others, and not stop().
    void start(const Limits& limits, Report report, Report done);
    // Ends the think within 5 ms (once every root move is known, however few its visits) and
    // returns when `done` has returned.
    void stop();
    // Returns when the think is over by itself and `done` has returned.
    void wait() const;
    // Asks for the end and returns at once; from any thread.
    void interrupt();
    void ponder_hit();
    bool thinking() const;

    // A consistent picture, at any time, from any thread; the last think's when idle.
    Analysis analysis(int most_moves = 0x7fffffff, int variation_length = 32) const;

    // start, wait for the end, return the picture. For callers without a protocol.
    Analysis think(const Limits& limits);

    // What the next clocked think will keep back.
    Milliseconds lag() const { return Milliseconds(params_.lag_ms) + late_.reserve(); }

   private:
    using Clock = std::chrono::steady_clock;

    // What settings leave to the network, settled. Fails where the search would go by values that
    // it does not tell.
    static SearchParams settled(SearchParams given, const EvaluatorSource<G>* network);
    void rebuild(const SearchParams& params);
    bool uses_network() const { return network_ && params_.method != Method::uct; }
    bool uses_alphago() const { return uses_network() && params_.method == Method::alphago; }
    bool uses_gumbel() const { return uses_network() && params_.method == Method::gumbel; }
    // Analysis without an end shows what is there, at full strength.
    static bool plays(const Limits& limits) { return !limits.endless(); }
    bool limits_strength(const Limits& limits) const {
        return params_.level < full_level && plays(limits);
    }
    std::unique_ptr<LeafEvaluator<G>> make_leaf_evaluator(std::uint64_t seed) const;
    // Leaves that a worker asks the network about at once.
    int batch() const {
        if (!uses_network() || uses_alphago()) return 1;
        return params_.batch > 0 ? params_.batch : network_->batch(position());
    }
    void hire();
    void reset_tallies();
    void begin(const Limits& limits);
    void begin_tree(const Limits& limits);
    void begin_team(const Limits& limits);
    void take_effect(const Limits& limits);
    void prepare_root();
    void meet();
    void choose();
    std::optional<Move> draw_move(float temperature);
    Telling telling(int most_moves, int variation_length) const;
    void run(int index, const Report& report, const Report& done);
    void work(Worker<G>& worker);
    void conduct(const Report& report, const Report& done);
    TimePoint next_event(TimePoint next_report) const;
    std::optional<Milliseconds> last_moment() const;
    bool over();
    void complete(MoveAnalysis& move, int variation_length) const;
    void add_owners(Analysis& picture) const;
    static Milliseconds since(TimePoint start) {
        return std::chrono::duration_cast<Milliseconds>(Clock::now() - start);
    }

    SearchParams given_, params_;  // as they were set; settled
    std::shared_ptr<const EvaluatorSource<G>> network_;
    std::shared_ptr<EvaluationCache> cache_;  // with a network
    std::shared_ptr<LateLeaves<G>> unanswered_ = std::make_shared<LateLeaves<G>>();
    std::shared_ptr<CoreShare> share_;  // in AlphaGo's search, over all thinks
    std::unique_ptr<TreeSearch<G>> search_;
    std::vector<std::unique_ptr<Worker<G>>> workers_;
    LagMeter late_;
    engine::Random random_{0};  // of noise and temperature
    bool noisy_ = false;        // the priors at the root have their noise

    // Readers of the tree against whoever moves its parts; never taken in a simulation.
    mutable std::mutex picture_mutex_;
    TimePoint started_{};
    std::string fault_;
    std::optional<Milliseconds> elapsed_;  // once the think is over
    std::optional<Move> chosen_;           // then, where it need not be the first in order

    // The conductor of a think against its owner and workers.
    mutable std::mutex mutex_;
    mutable std::condition_variable changed_;
    Limits limits_;
    std::optional<Schedule> schedule_;  // once the limits have taken effect
    TimePoint effective_{};
    Milliseconds overslept_{0};  // by the conductor, at worst
    std::optional<float> previous_value_;
    std::size_t working_ = 0;
    bool interrupted_ = false;
    bool ended_ = true;  // `done` has returned

    std::unique_ptr<Team> team_ = std::make_unique<Team>();
    std::unique_ptr<Crew> crew_;  // the workers, then the conductor; last, to end first
};

template <engine::Game G>
void Searcher<G>::rebuild(const SearchParams& params) {
    params_ = params;
    const std::lock_guard lock(picture_mutex_);
    search_.reset();
    cache_.reset();
    auto for_tree = params;
    if (uses_network()) {
        // An eighth of the budget remembers what the network said.
        const int mebibytes = params.memory_mib / 8;
        cache_ = std::make_shared<EvaluationCache>(static_cast<std::size_t>(mebibytes) << 20);
        for_tree.memory_mib -= mebibytes;
    }
    search_ = std::make_unique<TreeSearch<G>>(for_tree, uses_network());
    hire();
}

template <engine::Game G>
SearchParams Searcher<G>::settled(SearchParams given, const EvaluatorSource<G>* network) {
    if (!network) return given;
    if (given.method == Method::automatic && network->blends()) given.method = Method::alphago;
    const bool alphago = given.method == Method::alphago;
    if (given.lambda < 0) given.lambda = alphago ? 0.5f : network->rollout_share();
    if (network->has_value()) return given;
    given.lambda = 1;
    if (given.method != Method::uct && !alphago)
        engine::fail("the network {} has no value: it needs --search alphago", network->name());
    return given;
}

template <engine::Game G>
void Searcher<G>::set_network(std::shared_ptr<const EvaluatorSource<G>> network) {
    crew_->wait();
    const G root = position();
    if (network) network->check(root);
    const auto params = settled(given_, network.get());
    network_ = std::move(network);
    rebuild(params);
    set_position(root);
}

template <engine::Game G>
void Searcher<G>::warm_up() {
    check(position());
    crew_->start([this](int index) {
        const auto at = static_cast<std::size_t>(index);
        if (at < workers_.size()) workers_[at]->warm_up(position(), batch());
    });
    crew_->wait();
}

template <engine::Game G>
std::unique_ptr<LeafEvaluator<G>> Searcher<G>::make_leaf_evaluator(std::uint64_t seed) const {
    if (!uses_network()) return std::make_unique<RolloutLeaf<G>>(seed);
    auto network =
        uses_alphago() ? network_->make_evaluator_of(params_.prior) : network_->make_evaluator();
    auto turned = std::make_unique<SymmetryEvaluator<G>>(std::move(network), seed);
    auto cached = std::make_unique<CachedEvaluator<G>>(std::move(turned), cache_);
    if (uses_alphago())
        return std::make_unique<AlphaGoLeaf<G>>(
            std::move(cached), network_->make_rollouts(), unanswered_, share_,
            AlphaGoParams{.lambda = params_.lambda,
                          .temperature = params_.alphago_temperature,
                          .batch = std::max(params_.batch, 1),
                          .n_thr = params_.n_thr},
            seed);
    typename NetworkLeaf<G>::Temperatures temperatures;
    temperatures.elsewhere = params_.policy_temperature > 0 ? params_.policy_temperature
                                                            : network_->policy_temperature();
    const float root = params_.root_policy_temperature;
    temperatures.root = root > 0 ? root : temperatures.elsewhere;
    typename NetworkLeaf<G>::Rollouts rollouts(*network_, params_.lambda, params_.rollouts, seed);
    return std::make_unique<NetworkLeaf<G>>(std::move(cached), params_.root_symmetries,
                                            temperatures, std::move(rollouts));
}

template <engine::Game G>
void Searcher<G>::hire() {
    crew_.reset();
    workers_.clear();
    share_ = std::make_shared<CoreShare>(params_.network_share);
    for (int i = 0; i < params_.threads; ++i) {
        const auto seed = static_cast<std::uint64_t>(params_.seed) << 32 | static_cast<unsigned>(i);
        workers_.push_back(std::make_unique<Worker<G>>(make_leaf_evaluator(seed)));
    }
    crew_ = std::make_unique<Crew>(params_.threads + 1);
    random_ = engine::Random(static_cast<std::uint64_t>(params_.seed));
}

template <engine::Game G>
void Searcher<G>::set_params(const SearchParams& given) {
    crew_->wait();
    const auto params = settled(given, network_.get());
    given_ = given;
    const auto old = std::exchange(params_, params);
    if (old.memory_mib != params.memory_mib || old.method != params.method ||
        old.prior != params.prior) {
        const G root = position();
        rebuild(params);
        return set_position(root);
    }
    const std::lock_guard lock(picture_mutex_);
    search_->set_params(params);
    if (old.draw_score != params.draw_score) search_->set_root(G(position()));
    const auto workers = [](const SearchParams& of) {
        return std::tuple(of.threads, of.seed, of.batch, of.root_symmetries, of.policy_temperature,
                          of.root_policy_temperature, of.lambda, of.rollouts,
                          of.alphago_temperature, of.n_thr, of.network_share);
    };
    if (workers(old) != workers(params)) hire();
}

template <engine::Game G>
void Searcher<G>::set_position(const G& root) {
    crew_->wait();
    check(root);
    const std::lock_guard lock(picture_mutex_);
    if (root == position()) return;
    reset_tallies();
    const auto line = search_->line_to(root);
    if (line.empty()) return search_->set_root(root);
    for (const Move move : line) search_->advance(move);
}

template <engine::Game G>
void Searcher<G>::advance(Move move) {
    crew_->wait();
    const std::lock_guard lock(picture_mutex_);
    search_->advance(move);
    reset_tallies();
}

template <engine::Game G>
void Searcher<G>::clear() {
    crew_->wait();
    const std::lock_guard lock(picture_mutex_);
    search_->set_root(G(position()));
    reset_tallies();
    hire();
}

template <engine::Game G>
void Searcher<G>::reset_tallies() {
    noisy_ = false;
    for (const auto& worker : workers_)
        if (auto* tally = worker->tally()) tally->reset();
}

template <engine::Game G>
Analysis Searcher<G>::analysis(int most_moves, int variation_length) const {
    const std::lock_guard lock(picture_mutex_);
    const Tree& tree = search_->tree();
    const Node& root = tree[tree.root()];
    Analysis picture;
    picture.visits = root.visits;
    picture.value = -tree.value(root);
    picture.elapsed = elapsed_.value_or(since(started_));
    std::uint64_t steps = 0, deepest = 0;
    for (const auto& worker : workers_) {
        picture.simulations += worker->simulations();
        steps += worker->steps();
        deepest = std::max(deepest, worker->deepest());
    }
    picture.depth = picture.simulations ? static_cast<int>(steps / picture.simulations) : 0;
    picture.deepest = static_cast<int>(deepest);
    picture.memory_used = static_cast<float>(tree.share_used());
    picture.draws = root.draws.value();
    picture.draw_score = params_.draw_score;
    picture.moves = describe_moves(tree, search_->filter(), telling(most_moves, variation_length));
    for (auto& move : picture.moves) complete(move, variation_length);
    picture.fault = fault_;
    add_owners(picture);
    return picture;
}

template <engine::Game G>
Telling Searcher<G>::telling(int most_moves, int variation_length) const {
    Telling telling;
    telling.most_moves = most_moves;
    telling.variation_length = variation_length;
    telling.draw_score = params_.draw_score;
    telling.first = chosen_;
    telling.by_bound = uses_network() && !uses_alphago() && params_.lower_bound;
    return telling;
}

// A line that ends in a mate which was seen before it was searched.
template <engine::Game G>
void Searcher<G>::complete(MoveAnalysis& move, int variation_length) const {
    if constexpr (requires(const G& game) { game.forced_mate(); }) {
        const int plies = std::min(std::abs(move.sure.value_or(0)), variation_length);
        const auto missing = [&] { return plies - static_cast<int>(move.variation.size()); };
        if (missing() <= 0) return;
        G game(position());
        for (const Move played : move.variation) game.play(played);
        while (missing() > 0) {
            const auto mate = game.forced_mate();
            if (!mate) return;
            const Move next = mate->mates ? mate->move : game.legal_moves()[0];
            move.variation.push_back(next);
            move.variation_visits.push_back(0);
            game.play(next);
        }
    }
}

template <engine::Game G>
void Searcher<G>::add_owners(Analysis& picture) const {
    OwnerTally::Sum sum;
    for (const auto& worker : workers_)
        if (const auto* tally = worker->tally()) tally->add_to(sum);
    if (sum.lengths > 0)
        picture.plies_left = static_cast<float>(sum.plies / static_cast<double>(sum.lengths));
    if (sum.rollouts == 0) return;
    const double sign = position().to_play() == engine::Player::first ? 1 : -1;
    const double scale = sign / static_cast<double>(sum.rollouts);
    picture.lead = static_cast<float>(scale * sum.lead);
    for (const double owner : sum.owners)
        picture.owners.push_back(static_cast<float>(scale * owner));
}

}  // namespace search

#include "search/searcher_think.h"

namespace search {

// Each compiled once, in a file of its own: nearly all of the search lies behind these.
extern template class Searcher<go::Go>;
extern template class Searcher<chess::Chess>;
extern template class Searcher<shogi::Shogi>;

}  // namespace search
