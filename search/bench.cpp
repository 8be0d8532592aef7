#include "search/bench.h"

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <span>

#include "engine/base/measure.h"
#include "engine/games.h"
#include "search/searcher.h"

namespace search {

namespace {

SearchParams one_thread() {
    SearchParams params;
    params.memory_mib = 64;
    params.early_end = false;
    return params;
}

// FNV-1a, 32 bits.
void mix(std::uint32_t& hash, std::uint64_t number) {
    for (int byte = 0; byte < 8; ++byte) {
        hash ^= static_cast<std::uint8_t>(number >> 8 * byte);
        hash *= 16777619u;
    }
}

// From the start and after 30 random moves, the tree kept for one more think.
template <engine::Game G>
void mix_game(std::uint32_t& hash, const G& start, std::uint64_t simulations) {
    Searcher<G> searcher(one_thread());
    engine::Random random(1);
    Limits limits;
    limits.simulations = simulations;
    G game = start;
    for (int moves = 0; moves <= 31 && game.outcome() == engine::Outcome::ongoing; ++moves) {
        if (moves == 0 || moves >= 30) {
            searcher.set_position(game);
            const auto picture = searcher.think(limits);
            mix(hash, picture.visits);
            for (const auto& move : picture.moves) mix(hash, move.visits << 16 | move.move.code);
            game.play(picture.moves.at(0).move);
        } else {
            const auto legal = game.legal_moves();
            game.play(legal[random.below(legal.size())]);
        }
    }
}

double simulations_per_second(const go::Go& game, double seconds) {
    Searcher<go::Go> searcher(one_thread());
    searcher.set_position(game);
    Limits limits;
    limits.time = Milliseconds(static_cast<std::int64_t>(seconds * 1000));
    const auto picture = searcher.think(limits);
    const std::chrono::duration<double> took = picture.elapsed;
    return static_cast<double>(picture.simulations) / took.count();
}

// What a network of no cost would say: priors and values that differ from position to position.
template <engine::Game G>
class FreeEvaluator final : public Evaluator<G> {
   public:
    void evaluate(std::span<const Query<G>> queries) override {
        for (const auto& query : queries) answer(query);
    }
    int symmetries(const G&) const override { return 1; }
    std::uint64_t key(const G& game) const override { return game.key(); }

   private:
    static void answer(const Query<G>& query) {
        const auto count = static_cast<std::size_t>(query.moves->size());
        auto noise = query.game->key();
        auto& priors = query.answer->priors;
        priors.resize(count);
        float sum = 0;
        for (float& prior : priors) {
            noise = noise * 6364136223846793005u + 1442695040888963407u;
            const auto drawn = static_cast<float>(noise >> 40) / (1 << 24);
            sum += prior = drawn * drawn * drawn;
        }
        for (float& prior : priors) prior /= sum;
        query.answer->win = static_cast<float>(noise >> 44 & 0xffff) / 65536;
        query.answer->loss = 1 - query.answer->win;
    }
};

template <engine::Game G>
class FreeSource final : public EvaluatorSource<G> {
   public:
    std::unique_ptr<Evaluator<G>> make_evaluator() const override {
        return std::make_unique<FreeEvaluator<G>>();
    }
    std::string_view name() const override { return "free"; }
    void check(const G&) const override {}
    int policy_index(const G&, Move) const override { return 0; }
};

// Simulations a second of all threads together under PUCT with an evaluator that costs nothing, by
// the time that the processor gave them.
template <engine::Game G>
double puct_per_second(const G& game, int threads, double seconds) {
    auto params = one_thread();
    params.memory_mib = 2048;
    params.threads = threads;
    Searcher<G> searcher(params);
    searcher.set_position(game);
    searcher.set_network(std::make_shared<FreeSource<G>>());
    Limits limits;
    limits.time = Milliseconds(static_cast<std::int64_t>(seconds * 1000));
    searcher.think(limits);  // the first touch of memory is the system's work, not the search's
    double took = 0, simulations = 0;
    constexpr int most_thinks = 10;
    for (int i = 0; i < most_thinks && took < seconds / 2; ++i) {
        const double before = engine::process_seconds();
        simulations += static_cast<double>(searcher.think(limits).simulations);
        took += (engine::process_seconds() - before) / threads;
    }
    return simulations / took;
}

template <engine::Game G>
void add_puct(std::vector<engine::Figure>& figures, std::string_view name, const G& game,
              double seconds) {
    constexpr auto unit = "simulations/s";
    const auto sims = fmt::format("{}_sims", name);
    figures.push_back({sims, puct_per_second(game, 1, seconds), unit});
    figures.push_back({sims + "_2_threads", puct_per_second(game, 2, seconds), unit});
}

}  // namespace

std::uint32_t signature(std::uint64_t simulations) {
    std::uint32_t hash = 2166136261u;
    mix_game(hash, go::Go(9), simulations);
    mix_game(hash, go::Go(19), simulations / 4);
    mix_game(hash, chess::Chess{}, simulations / 10);
    mix_game(hash, shogi::Shogi{}, simulations / 10);
    return hash;
}

std::vector<engine::Figure> bench_search(double seconds) {
    std::vector<engine::Figure> figures = {
        {"signature", static_cast<double>(signature()), "hash"},
        {"go9_uct_sims", simulations_per_second(go::Go(9), seconds), "simulations/s"},
        {"go19_uct_sims", simulations_per_second(go::Go(19), seconds), "simulations/s"},
    };
    add_puct(figures, "chess", chess::Chess{}, seconds);
    add_puct(figures, "shogi", shogi::Shogi{}, seconds);
    add_puct(figures, "go9", go::Go(9), seconds);
    add_puct(figures, "go19", go::Go(19), seconds);
    figures.push_back({"node_bytes", static_cast<double>(sizeof(Node)), "bytes"});
    figures.push_back({"edge_bytes", static_cast<double>(sizeof(Edge)), "bytes"});
    return figures;
}

}  // namespace search
