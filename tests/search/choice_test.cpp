// What a search is sure of, and which move it comes down to.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <set>
#include <thread>

#include "search/network_evaluator.h"
#include "search/searcher.h"
#include "tests/search/fake_network.h"
#include "tests/search/tictactoe.h"

using tictactoe::TicTacToe;
using namespace std::chrono_literals;

namespace search {
namespace {

using Answer = std::function<void(const Query<TicTacToe>&)>;

template <class G>
class Source final : public EvaluatorSource<G> {
   public:
    explicit Source(Answer answer) : answer_(std::move(answer)) {}
    std::unique_ptr<Evaluator<G>> make_evaluator() const override {
        auto made = std::make_unique<fake::Network>();
        made->answer = answer_;
        return made;
    }
    std::string_view name() const override { return "fake"; }
    void check(const G&) const override {}
    int policy_index(const G&, engine::Move move) const override { return move.code; }

   private:
    Answer answer_;
};

// Knows nothing: even priors, even value.
void even(const Query<TicTacToe>& query) { query.answer->win = query.answer->loss = 0.5f; }

SearchParams small() {
    SearchParams params;
    params.memory_mib = 64;
    params.early_end = false;
    return params;
}

Limits simulations(std::uint64_t count) {
    Limits limits;
    limits.simulations = count;
    return limits;
}

Analysis searched(const SearchParams& params, std::string_view moves, const Limits& limits,
                  const Answer& answer = even) {
    Searcher<TicTacToe> searcher(params);
    searcher.set_network(std::make_shared<Source<TicTacToe>>(answer));
    searcher.set_position(TicTacToe::from_text(moves));
    return searcher.think(limits);
}

Move cell(int number) { return {static_cast<std::uint16_t>(number - 1)}; }

TEST(Solver, AWinInOneIsSure) {
    const auto best = searched(small(), "1425", simulations(300)).moves.at(0);
    EXPECT_EQ(best.move, cell(3));
    EXPECT_EQ(best.sure, 1);
    EXPECT_EQ(best.value, 1.0f);
}

// The first player threatens two lines.
TEST(Solver, ALossIsSureWhateverIsPlayed) {
    auto params = small();
    params.early_end = true;
    const auto picture = searched(params, "12594", simulations(100000));
    EXPECT_LT(picture.simulations, 10000u);
    EXPECT_EQ(picture.moves.size(), 4u);
    for (const auto& move : picture.moves) EXPECT_EQ(move.sure, -2) << move.move.code;
    EXPECT_EQ(picture.moves.at(0).value, -1.0f);
}

TEST(Solver, AWinInThreePliesIsSure) {
    const auto best = searched(small(), "1259", simulations(5000)).moves.at(0);
    EXPECT_EQ(best.sure, 3);
    ASSERT_EQ(best.variation.size(), 3u);
}

TEST(Solver, RolloutsAreSolvedToo) {
    auto params = small();
    params.method = Method::uct;
    EXPECT_EQ(searched(params, "1259", simulations(5000)).moves.at(0).sure, 3);
}

TEST(Solver, TheWholeGameIsADraw) {
    auto params = small();
    params.early_end = true;
    const auto picture = searched(params, "", simulations(10000000));
    EXPECT_LT(picture.simulations, 10000000u);
    for (const auto& move : picture.moves) EXPECT_EQ(move.sure, 0) << move.move.code;
}

TEST(Solver, AnEndlessThinkGoesOnWhenAllIsSure) {
    Searcher<TicTacToe> searcher(small());
    searcher.set_position(TicTacToe::from_text("12594"));
    searcher.start({}, {}, {});
    std::this_thread::sleep_for(30ms);
    EXPECT_TRUE(searcher.thinking());
    searcher.stop();
    EXPECT_EQ(searcher.analysis().moves.at(0).sure, -2);
}

TEST(Solver, TheMoveAfterASureOneIsStillSearched) {
    Searcher<TicTacToe> searcher(small());
    searcher.set_position(TicTacToe::from_text("1259"));
    const auto best = searcher.think(simulations(5000)).moves.at(0);
    searcher.advance(best.move);
    const auto reply = searcher.think(simulations(100)).moves.at(0);
    EXPECT_EQ(reply.sure, -2);
    searcher.advance(reply.move);
    EXPECT_EQ(searcher.think(simulations(100)).moves.at(0).sure, 1);
}

// Drawn by some rule after two plies, yet it may be played on.
struct Claimable : TicTacToe {
    static Claimable from_text(std::string_view text) { return {TicTacToe::from_text(text)}; }
    engine::Outcome outcome() const {
        return legal_moves().size() == 7 ? engine::Outcome::draw : TicTacToe::outcome();
    }
};

TEST(Solver, ADrawnRootThatMayBePlayedOnIsSearched) {
    Searcher<Claimable> searcher(small());
    searcher.set_position(Claimable::from_text("12"));
    const auto picture = searcher.think(simulations(3000));
    EXPECT_EQ(picture.visits, 3000u);
    ASSERT_EQ(picture.moves.size(), 7u);
    EXPECT_GT(picture.moves[0].value, 0);
    // Likewise when it was a leaf of the tree before.
    searcher.set_position(Claimable::from_text("1"));
    searcher.think(simulations(1000));
    searcher.advance(cell(2));
    EXPECT_GT(searcher.think(simulations(3000)).moves.at(0).value, 0);
}

TEST(DrawScore, ADrawIsWorthWhatIsSaidToTheSideThatThinks) {
    const auto drawn = [](const Query<TicTacToe>& query) {
        query.answer->win = query.answer->loss = 0;
        query.answer->draw = 1;
    };
    auto params = small();
    params.draw_score = -0.5f;
    const auto picture = searched(params, "", simulations(50), drawn);
    EXPECT_NEAR(picture.value, -0.5, 1e-3);
    EXPECT_NEAR(picture.draws, 1, 1e-3);
    EXPECT_NEAR(picture.moves.at(0).draws, 1, 1e-3);
    EXPECT_NEAR(searched(params, "5", simulations(50), drawn).value, -0.5, 1e-3);
}

SearchParams gumbel() {
    auto params = small();
    params.method = Method::gumbel;
    return params;
}

TEST(GumbelSearch, TakesAWinInOneAndBlocksALoss) {
    EXPECT_EQ(searched(gumbel(), "1425", simulations(100)).moves.at(0).move, cell(3));
    EXPECT_EQ(searched(gumbel(), "152", simulations(200)).moves.at(0).move, cell(3));
}

TEST(GumbelSearch, HalvesItsCandidates) {
    auto params = gumbel();
    params.gumbel_moves = 4;
    auto counts = std::multiset<std::uint64_t>();
    // One simulation is the root's own.
    for (const auto& move : searched(params, "", simulations(17)).moves) counts.insert(move.visits);
    EXPECT_EQ(counts, (std::multiset<std::uint64_t>{0, 0, 0, 0, 0, 2, 2, 6, 6}));
}

TEST(GumbelSearch, WorkersShareIt) {
    auto params = gumbel();
    params.threads = 4;
    params.batch = 2;
    const auto picture = searched(params, "152", simulations(2000));
    EXPECT_EQ(picture.visits, 2000u);
    EXPECT_EQ(picture.moves.at(0).move, cell(3));
}

TEST(GumbelSearch, NeedsNoNumberOfSimulations) {
    Limits limits;
    limits.time = 400ms;
    const auto picture = searched(gumbel(), "152", limits);
    EXPECT_EQ(picture.moves.at(0).move, cell(3));
    EXPECT_GT(picture.simulations, 10u);
}

// The moves that eight seeds come to at the start of a game.
std::set<int> chosen(SearchParams params, int ply) {
    std::set<int> moves;
    auto limits = simulations(100);
    limits.ply = ply;
    for (params.seed = 1; params.seed <= 8; ++params.seed)
        moves.insert(searched(params, "", limits).moves.at(0).move.code);
    return moves;
}

TEST(Choice, ATemperatureDrawsTheMoveInTheFirstPliesOnly) {
    auto params = small();
    EXPECT_EQ(chosen(params, 0).size(), 1u);
    params.temperature = 1;
    params.temperature_plies = 10;
    EXPECT_GT(chosen(params, 0).size(), 2u);
    EXPECT_EQ(chosen(params, 10).size(), 1u);
}

TEST(Choice, ASureWinIsNotLeftToChance) {
    auto params = small();
    params.temperature = 10;
    for (params.seed = 1; params.seed <= 8; ++params.seed)
        EXPECT_EQ(searched(params, "1425", simulations(200)).moves.at(0).move, cell(3));
}

TEST(Choice, NoiseChangesThePriorsAtTheRootOnce) {
    auto params = small();
    params.noise = 0.5f;
    params.noise_alpha = 0.3f;
    Searcher<TicTacToe> searcher(params);
    searcher.set_network(std::make_shared<Source<TicTacToe>>(even));
    const auto priors = [](const Analysis& picture) {
        std::vector<float> values(9);
        for (const auto& move : picture.moves) values[move.move.code] = move.prior;
        return values;
    };
    const auto first = priors(searcher.think(simulations(20)));
    EXPECT_GT(*std::max_element(first.begin(), first.end()), 0.15f);
    EXPECT_EQ(priors(searcher.think(simulations(20))), first);
    searcher.clear();
    EXPECT_EQ(priors(searcher.think(simulations(20))), first);
}

TEST(Choice, PolicyTemperatureEvensThePriors) {
    const auto lean = [](const Query<TicTacToe>& query) {
        even(query);
        query.answer->priors.assign(9, 0.05f);
        query.answer->priors[4] = 0.6f;
    };
    auto params = small();
    params.policy_temperature = 2;
    const float best = searched(params, "", simulations(1), lean).moves.at(0).prior;
    EXPECT_NEAR(best, std::sqrt(0.6) / (std::sqrt(0.6) + 8 * std::sqrt(0.05)), 1e-3);
    params.root_policy_temperature = 1;
    EXPECT_NEAR(searched(params, "", simulations(1), lean).moves.at(0).prior, 0.6, 1e-3);
}

// What a small network's search of a few visits comes to.
template <class G>
Analysis asked(const SearchParams& params, const std::string& source, const G& game = G(),
               std::uint64_t visits = 1) {
    auto graph = fake::small_network<G>();
    graph.facts.source = source;
    Searcher<G> searcher(params);
    searcher.set_position(game);
    searcher.set_network(std::make_shared<NetworkSource<G>>(
        std::make_shared<const Network>(std::move(graph), nn::Precision::fp32)));
    return searcher.think(simulations(visits));
}

TEST(Solver, ANearMateIsTriedFirstAndSeenAtOnce) {
    const auto game = shogi::Shogi::from_text("8k/9/7+P1/4L4/9/9/9/9/4K4 b B 1");
    const auto best = asked(small(), "sanban train", game, 2).moves.at(0);
    EXPECT_EQ(game.move_to_text(best.move), "B*3c");
    EXPECT_GT(best.prior, 0.5f);
    EXPECT_EQ(best.sure, 3);
    auto blind = small();
    blind.solver = false;
    EXPECT_LT(asked(blind, "sanban train", game, 2).moves.at(0).prior, 0.5f);
}

// The highest prior at the root.
template <class G>
float most_likely(float temperature, const std::string& source = "sanban train") {
    auto params = small();
    params.policy_temperature = temperature;
    float most = 0;
    for (const auto& move : asked<G>(params, source).moves) most = std::max(most, move.prior);
    return most;
}

TEST(Choice, WithoutAPolicyTemperatureTheNetworkHasItsOwn) {
    EXPECT_EQ(most_likely<chess::Chess>(0), most_likely<chess::Chess>(1.7f));
    EXPECT_EQ(most_likely<shogi::Shogi>(0), most_likely<shogi::Shogi>(1.5f));
    EXPECT_EQ(most_likely<go::Go>(0), most_likely<go::Go>(1));
    EXPECT_EQ(most_likely<chess::Chess>(0, "lc0"), most_likely<chess::Chess>(1, "lc0"));
    EXPECT_LT(most_likely<chess::Chess>(0), most_likely<chess::Chess>(1));
}

template <class G>
float value_of(float lambda, const std::string& text, const std::string& source = "sanban train") {
    auto params = small();
    params.lambda = lambda;
    return asked<G>(params, source, G::from_text(text)).value;
}

// Captures played out again say the same again.
static_assert(engine::playouts_vary<go::Go> && !engine::playouts_vary<chess::Chess> &&
              !engine::playouts_vary<shogi::Shogi>);

TEST(Choice, WithoutALambdaCapturesCountAsSuitsTheGame) {
    const std::string queen = "4k3/8/8/8/8/8/8/Q3K3 w - - 0 1";
    const float alone = value_of<chess::Chess>(0, queen);
    const float captures = std::tanh(900.0f / 300);
    EXPECT_NEAR(value_of<chess::Chess>(-1, queen), (alone + captures) / 2, 1e-4f);
    EXPECT_EQ(value_of<chess::Chess>(-1, queen, "lc0"), alone);
    const std::string rook = "4k4/9/9/9/9/9/9/9/4K4 b R 1";
    EXPECT_EQ(value_of<shogi::Shogi>(-1, rook), value_of<shogi::Shogi>(0.5f, rook));
    EXPECT_NE(value_of<shogi::Shogi>(-1, rook), value_of<shogi::Shogi>(0, rook));
}

TEST(Level, TheLowestKnowsNextToNothingAndTheHighestAll) {
    auto params = small();
    params.level = 0;
    EXPECT_EQ(searched(params, "", simulations(1000)).simulations, 2u);
    params.level = full_level;
    EXPECT_EQ(searched(params, "", simulations(1000)).simulations, 1000u);
}

TEST(Level, DoesNotWeakenAnAnalysis) {
    auto params = small();
    params.level = 0;
    Searcher<TicTacToe> searcher(params);
    searcher.start({}, {}, {});
    while (searcher.analysis().visits < 1000) std::this_thread::sleep_for(1ms);
    EXPECT_TRUE(searcher.thinking());
    searcher.stop();
}

TEST(Level, MoreOfItIsMore) {
    for (int level = 1; level < full_level; ++level) {
        EXPECT_GT(simulations_of_level(level), simulations_of_level(level - 1));
        EXPECT_LT(temperature_of_level(level), temperature_of_level(level - 1));
    }
}

TEST(Level, RatingsSpanAllLevels) {
    EXPECT_EQ(level_of_elo(weakest_elo), 0);
    EXPECT_EQ(level_of_elo(strongest_elo), full_level);
}

TEST(Fault, OneAtTheRootLeavesNoMoveAndAMessage) {
    const auto broken = [](const Query<TicTacToe>&) { engine::fail("no number"); };
    const auto picture = searched(small(), "", simulations(10), broken);
    EXPECT_EQ(picture.fault, "no number");
    EXPECT_TRUE(picture.moves.empty());
}

}  // namespace
}  // namespace search
