// AlphaGo's search: two counts an edge, leaves that networks judge late, and sets of its networks.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "engine/base/error.h"
#include "engine/games.h"
#include "nn/builders.h"
#include "nn/load.h"
#include "search/core_share.h"
#include "search/linear_network.h"
#include "search/load_player.h"
#include "search/policy_player.h"
#include "search/searcher.h"
#include "tests/search/fake_network.h"
#include "tests/search/tictactoe.h"
#include "tests/temporary_folder.h"

namespace search {
namespace {

using tictactoe::TicTacToe;

class FakeSource final : public EvaluatorSource<TicTacToe> {
   public:
    std::unique_ptr<Evaluator<TicTacToe>> make_evaluator() const override {
        auto made = std::make_unique<fake::Network>();
        made->answer = [](const Query<TicTacToe>& query) {
            query.answer->win = query.answer->loss = 0.5f;
        };
        return made;
    }
    std::string_view name() const override { return "fake"; }
    void check(const TicTacToe&) const override {}
    int policy_index(const TicTacToe&, engine::Move move) const override { return move.code; }
};

engine::MoveList two_moves() {
    engine::MoveList moves;
    moves.push({1});
    moves.push({2});
    return moves;
}

// A root with two visited children.
struct TwoChildren {
    Tree tree{std::size_t{1} << 20};
    Path first, second;

    TwoChildren() {
        EXPECT_TRUE(tree.claim(tree.root()));
        EXPECT_TRUE(tree.expand(tree.root(), two_moves(), std::vector<float>{0.5f, 0.5f}));
        for (auto* path : {&first, &second}) {
            auto& edge = tree.edges_to_enter(tree.root())[path == &first ? 0 : 1];
            tree.enter_root();
            *path = {tree.root(), tree.enter(edge)};
        }
    }
    TwoChildren(const TwoChildren&) = delete;
    TwoChildren& operator=(const TwoChildren&) = delete;
    ~TwoChildren() = default;
};

TEST(TwoCounts, BlendsRolloutsAndNetworks) {
    TwoChildren two;
    // As the mover at the child sees it, which is the other side.
    two.tree.back_up(two.first, -1);
    two.tree.add_network_value(two.first, 0.5f);
    const Node& child = two.tree[two.first.back()];
    EXPECT_FLOAT_EQ(child.blended(1), 1);
    EXPECT_FLOAT_EQ(child.blended(0), -0.5f);
    EXPECT_FLOAT_EQ(child.blended(0.5f), 0.25f);
    const Node& root = two.tree[two.tree.root()];
    EXPECT_FLOAT_EQ(root.blended(0.25f), 0.25f * -1 + 0.75f * 0.5f);
    two.tree.set_blend(0.5f);
    EXPECT_FLOAT_EQ(two.tree.value(child), 0.25f);
}

TEST(TwoCounts, OneCountAloneWhereTheOtherIsMissing) {
    TwoChildren two;
    two.tree.back_up(two.first, -1);
    EXPECT_FLOAT_EQ(two.tree[two.first.back()].blended(0.5f), 1);
}

TEST(TwoCounts, TakesTheBetterChildAndCountsVirtualLosses) {
    TwoChildren two;
    two.tree.back_up(two.first, -0.5f);
    two.tree.back_up(two.second, 0.5f);
    const auto all = [](engine::Move) { return true; };
    const auto chosen = [&](const TwoCounts& rule) {
        return select(two.tree, two.tree.root(), rule, all)->move.code;
    };
    EXPECT_EQ(chosen({1, 1, 3}), 1);
    // Networks think otherwise.
    two.tree.add_network_value(two.first, 0.9f);
    two.tree.add_network_value(two.second, -0.9f);
    EXPECT_EQ(chosen({1, 0, 3}), 2);
    EXPECT_EQ(chosen({1, 1, 3}), 1);
    // A descent under way below the first makes it look lost.
    two.tree.enter(two.tree.edges_to_enter(two.tree.root())[0]);
    EXPECT_EQ(chosen({1, 1, 3}), 2);
    EXPECT_EQ(chosen({1, 1, 0}), 1);
}

TEST(TwoCounts, PriorsMayChangeLater) {
    TwoChildren two;
    two.tree.set_priors(two.tree.root(), std::vector<float>{0.25f, 0.75f});
    EXPECT_FLOAT_EQ(two.tree.edges(two.tree.root())[0].prior(), 0.25f);
    EXPECT_FLOAT_EQ(two.tree.edges(two.tree.root())[1].prior(), 0.75f);
}

SearchParams alphago_params() {
    SearchParams params;
    params.method = Method::alphago;
    params.memory_mib = 16;
    params.n_thr = 2;
    params.lag_ms = 0;
    return params;
}

Limits simulations(std::uint64_t count) {
    Limits limits;
    limits.simulations = count;
    return limits;
}

TEST(AlphaGoSearch, AFakeNetworkWins) {
    for (const float lambda : {0.0f, 0.5f, 1.0f})
        for (const int batch : {0, 1, 4}) {
            auto params = alphago_params();
            params.lambda = lambda;
            params.batch = std::max(batch, 1);
            if (batch == 0) params.n_thr = 0;
            Searcher<TicTacToe> searcher(params);
            searcher.set_network(std::make_shared<FakeSource>());
            // X to move wins in one.
            auto game = TicTacToe();
            for (const int code : {0, 3, 1, 4}) game.play({static_cast<std::uint16_t>(code)});
            searcher.set_position(game);
            const auto picture = searcher.think(simulations(200));
            ASSERT_FALSE(picture.moves.empty());
            EXPECT_EQ(picture.moves[0].move.code, 2) << lambda << ' ' << batch;
            EXPECT_TRUE(picture.fault.empty()) << picture.fault;
        }
}

TEST(AlphaGoSearch, OneThreadAndOneSeedGiveOneTree) {
    const auto think = [] {
        Searcher<TicTacToe> searcher(alphago_params());
        searcher.set_network(std::make_shared<FakeSource>());
        const auto picture = searcher.think(simulations(300));
        std::vector<std::uint64_t> visits;
        for (const auto& move : picture.moves) visits.push_back(move.visits);
        return visits;
    };
    EXPECT_EQ(think(), think());
}

// Visits at which leaves are handed on, and the networks' part of the time, once rollouts of 50 µs
// and answers of 2 ms have gone on for a while.
struct Settled {
    int visits;
    double networks;
};
Settled settled(float share) {
    using namespace std::chrono_literals;
    CoreShare cores(share);
    double rollouts = 0, networks = 0;
    int visits = 0;
    for (int simulation = 0; simulation < 400'000; ++simulation) {
        const bool counts = simulation > 200'000;
        cores.add_rollout(50us);
        rollouts += counts ? 0.05 : 0;
        if (++visits < cores.visits_to_expand()) continue;
        visits = 0;
        cores.add_networks(2ms);
        networks += counts ? 2 : 0;
    }
    return {cores.visits_to_expand(), networks / (networks + rollouts)};
}

TEST(CoreShare, NetworksGetTheirShareOfTheTime) {
    EXPECT_NEAR(settled(0.5f).visits, 40, 4);
    for (const float share : {0.2f, 0.5f, 0.8f})
        EXPECT_NEAR(settled(share).networks, share, 0.05) << share;
}

TEST(CoreShare, WithoutAnAnswerLeavesAreHandedOnSooner) {
    CoreShare cores(0.5f);
    for (int i = 0; i < 100; ++i) cores.add_rollout(std::chrono::milliseconds(50));
    EXPECT_EQ(cores.visits_to_expand(), 1);
}

// Sets of networks for 5x5 in a folder.
struct Folder {
    tests::TemporaryFolder folder;

    Folder() {
        engine::Random random(1);
        nn::Facts facts;
        facts.game = "go";
        facts.board = 5;
        facts.blocks = 2;
        facts.channels = 4;
        facts.encoding = "alphago48";
        save(nn::build_alphago_policy(facts, 48, random), "policy");
        save(nn::build_alphago_policy(facts, 48, random), "rl");
        facts.encoding = "alphago49";
        save(nn::build_alphago_value(facts, 49, random), "value");
        const std::vector<float> zeros(static_cast<std::size_t>(go::features::count));
        save(graph_of({zeros, zeros}), "rollout");
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() = default;

    void save(const nn::Graph& graph, const std::string& name) const {
        nn::save(graph, file(name));
    }
    std::filesystem::path file(const std::string& name) const {
        return folder.path() / (name + ".safetensors");
    }
    auto load(const go::Go& game = go::Go(5)) const {
        return load_player(folder.path().string(), nn::Precision::fp32, game);
    }
};

TEST(AlphaGoSet, PriorsByThePolicyValueByTheValueNetwork) {
    const Folder set;
    const auto source = set.load();
    const go::Go game(5);
    const auto moves = game.legal_moves();
    const auto ask = [&](Evaluator<go::Go>& evaluator) {
        Evaluation answer;
        const Query<go::Go> query{&game, &moves, 0, &answer};
        evaluator.evaluate({&query, 1});
        return answer;
    };
    const auto both = ask(*source->make_evaluator());
    NetworkEvaluator<go::Go> policy(
        std::make_shared<const Network>(nn::load(set.file("policy")), nn::Precision::fp32));
    NetworkEvaluator<go::Go> value(
        std::make_shared<const Network>(nn::load(set.file("value")), nn::Precision::fp32));
    EXPECT_EQ(both.priors, ask(policy).priors);
    EXPECT_EQ(both.value(), ask(value).value());
    EXPECT_EQ(ask(policy).value(), 0);
    EXPECT_TRUE(ask(value).priors.empty());
    EXPECT_NE(ask(*source->make_evaluator_of(Prior::reinforced)).priors, both.priors);
}

// All its networks, the value network by games that the policy plays.
TEST(AlphaGoSet, SaysNearlyTheSameInInt16) {
    const Folder set;
    const go::Go game(5);
    const auto exact = set.load();
    const auto source = load_player(set.folder.path().string(), nn::Precision::int16, game);
    const auto moves = game.legal_moves();
    for (const auto prior : {Prior::supervised, Prior::reinforced}) {
        Evaluation expected, found;
        const Query<go::Go> asked{&game, &moves, 0, &expected}, again{&game, &moves, 0, &found};
        exact->make_evaluator_of(prior)->evaluate({&asked, 1});
        source->make_evaluator_of(prior)->evaluate({&again, 1});
        EXPECT_NEAR(found.value(), expected.value(), 0.02);
        ASSERT_EQ(found.priors.size(), expected.priors.size());
        for (std::size_t i = 0; i < found.priors.size(); ++i)
            EXPECT_NEAR(found.priors[i], expected.priors[i], 0.01);
    }
}

TEST(AlphaGoSet, SearchesAndRollsOut) {
    const Folder set;
    auto params = alphago_params();
    for (const auto prior : {Prior::supervised, Prior::reinforced}) {
        params.prior = prior;
        params.threads = 2;
        params.batch = 4;
        params.early_end = false;
        Searcher<go::Go> searcher(params);
        searcher.set_position(go::Go(5));
        searcher.set_network(set.load());
        const auto picture = searcher.think(simulations(400));
        EXPECT_TRUE(picture.fault.empty()) << picture.fault;
        EXPECT_GT(picture.simulations, 300u);  // a slow worker is not waited for
        EXPECT_EQ(picture.owners.size(), 25u);
        EXPECT_LE(std::abs(picture.value), 1);
    }
}

TEST(AlphaGoSet, SaysWhatIsMissing) {
    const Folder set;
    EXPECT_THROW(set.load(go::Go(9)), engine::Error);
    std::filesystem::remove(set.file("rl"));
    const auto source = set.load();
    EXPECT_THROW(source->make_evaluator_of(Prior::reinforced), engine::Error);
    std::filesystem::remove(set.file("rollout"));
    EXPECT_NE(set.load()->make_rollouts(), nullptr);
    std::filesystem::copy(set.file("policy"), set.file("rollout"));
    EXPECT_THROW(set.load(), engine::Error);
    std::filesystem::remove(set.file("policy"));
    EXPECT_THROW(set.load(), engine::Error);
}

TEST(AlphaGoSet, WithoutAValueNetworkEverythingIsPlayedOut) {
    const Folder set;
    std::filesystem::remove(set.file("value"));
    EXPECT_FALSE(set.load()->has_value());
    auto params = alphago_params();
    params.method = Method::automatic;  // AlphaGo's, for such a set
    Searcher<go::Go> searcher(params);
    searcher.set_position(go::Go(5));
    searcher.set_network(set.load());
    const auto picture = searcher.think(simulations(400));
    EXPECT_GT(picture.simulations, 300u);
    EXPECT_EQ(picture.owners.size(), 25u);
    params.method = Method::puct;
    EXPECT_THROW(searcher.set_params(params), engine::Error);
    EXPECT_EQ(searcher.params().method, Method::automatic);
    EXPECT_THROW(Searcher<go::Go>(params).set_network(set.load()), engine::Error);
}

TEST(PolicyPlayer, DrawsSensibleMovesAndPassesLast) {
    const Folder set;
    PolicyPlayer<go::Go> player(
        std::make_shared<const Network>(nn::load(set.file("policy")), nn::Precision::fp32));
    engine::Random random(3);
    std::vector<go::Go> games(20, go::Go(5));
    for (int ply = 0; ply < 40; ++ply) {
        std::vector<const go::Go*> positions;
        for (const auto& game : games) positions.push_back(&game);
        const auto moves = player.draw(positions, random);
        ASSERT_EQ(moves.size(), games.size());
        for (std::size_t i = 0; i < games.size(); ++i) {
            ASSERT_TRUE(games[i].legal(moves[i]));
            const auto sensible = PolicyPlayer<go::Go>::sensible(games[i]);
            ASSERT_TRUE(sensible.contains(moves[i]));
            ASSERT_TRUE(moves[i] != go::Go::pass || sensible.size() == 1);
            games[i].play(moves[i]);
        }
    }
    EXPECT_NE(games[0], games[1]);
}

}  // namespace
}  // namespace search
