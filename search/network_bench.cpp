#include "search/network_bench.h"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "engine/games.h"
#include "search/load_network.h"

namespace search {

namespace {

using Figures = std::vector<engine::Figure>;

template <engine::Encoded G>
G start_on(const nn::Graph& graph, int board) {
    if (board == 0) board = graph.facts.board;
    if constexpr (requires { G(board); })
        if (board > 0) return G(board);
    return G();
}

// From the middle of a game of the network with itself.
template <engine::Encoded G>
std::vector<G> middle_positions(const std::shared_ptr<const Network>& network, const G& start,
                                int count) {
    constexpr int before = 24;
    NetworkEvaluator<G> evaluator(network);
    engine::Random random(1);
    const auto line = sample_lines(evaluator, start, 1, before + count - 1, random).front();
    return {line.end() - count, line.end()};
}

template <engine::Encoded G>
nn::Positions encoded(const nn::Graph& graph, const std::vector<G>& games) {
    const auto& encoding = engine::find_encoding<G>(graph.facts.encoding);
    std::vector<const G*> pointers;
    pointers.reserve(games.size());
    for (const G& game : games) pointers.push_back(&game);
    return calibration::encoded<G>(graph, encoding, encoding.shape(games[0]), pointers);
}

// Runs of the executor alone, a position at a time.
class Bare {
   public:
    Bare(const Network& network, const nn::Positions& positions)
        : positions_(positions), executor_(network.make_executor(positions.board)) {
        for (const auto size : network.output_sizes(positions.board)) numbers_.emplace_back(size);
        results_.assign(numbers_.begin(), numbers_.end());
    }

    double seconds() {
        const double start = engine::processor_seconds();
        for (std::size_t i = 0; i < static_cast<std::size_t>(positions_.size); ++i) {
            inputs_.clear();
            for (const auto& all : positions_.inputs) {
                const auto each = all.size() / static_cast<std::size_t>(positions_.size);
                inputs_.push_back(std::span(all).subspan(i * each, each));
            }
            executor_->run({1, positions_.board, inputs_, results_});
        }
        return engine::processor_seconds() - start;
    }

   private:
    const nn::Positions& positions_;
    std::unique_ptr<nn::Executor> executor_;
    std::vector<std::vector<float>> numbers_;
    std::vector<std::span<const float>> inputs_;
    std::vector<std::span<float>> results_;
};

// Evaluations one at a time; the legal moves are the search's to find.
template <engine::Encoded G>
class Whole {
   public:
    Whole(const std::shared_ptr<const Network>& network, const std::vector<G>& games)
        : games_(games), evaluator_(network) {
        for (const G& game : games) moves_.push_back(game.legal_moves());
    }

    double seconds() {
        const double start = engine::processor_seconds();
        for (std::size_t i = 0; i < games_.size(); ++i) {
            const Query<G> query{&games_[i], &moves_[i], 0, &answer_};
            evaluator_.evaluate({&query, 1});
        }
        return engine::processor_seconds() - start;
    }

   private:
    const std::vector<G>& games_;
    std::vector<engine::MoveList> moves_;
    NetworkEvaluator<G> evaluator_;
    Evaluation answer_;
};

// In percent; of several rounds the median.
template <engine::Encoded G>
double encoding_share(const std::shared_ptr<const Network>& network, const std::vector<G>& games) {
    constexpr int rounds = 7;
    const auto positions = encoded(network->graph(), games);
    Whole<G> evaluations(network, games);
    Bare bare(*network, positions);
    std::vector<double> shares;
    for (int i = 0; i < rounds; ++i) {
        const double whole =
            std::min({evaluations.seconds(), evaluations.seconds(), evaluations.seconds()});
        const double alone = std::min({bare.seconds(), bare.seconds(), bare.seconds()});
        shares.push_back(100 * (1 - alone / whole));
    }
    std::sort(shares.begin(), shares.end());
    return shares[rounds / 2];
}

template <engine::Encoded G>
Figures bench_game(const std::string& name, const nn::Graph& graph, PrecisionChoice choice,
                   nn::BenchSettings settings) {
    const auto start = start_on<G>(graph, settings.board);
    const auto network = load_network(name, choice, start)->network();
    spdlog::info("{} in {}", network->graph().facts.name, nn::name_of(network->precision()));
    settings.precision = network->precision();
    const auto games = middle_positions(network, start, std::max(settings.batch, 32));
    const auto batch =
        encoded(network->graph(), std::vector<G>(games.begin(), games.begin() + settings.batch));
    settings.board = batch.board;
    auto figures = nn::bench_network(network->graph(), settings, batch, network->calibration());
    figures.push_back({"encoding_share", encoding_share(network, games), "%"});
    return figures;
}

}  // namespace

Figures bench_weights(const std::string& name, PrecisionChoice choice, nn::BenchSettings settings) {
    const auto graph = nn::load(find_weights(name));
    return engine::Games::visit(
        graph.facts.game, [&]<class G>() { return bench_game<G>(name, graph, choice, settings); });
}

}  // namespace search
