// Evaluators and their decorators, each alone.
#include "search/evaluator.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <thread>

#include "engine/games.h"
#include "nn/builders.h"
#include "search/answer.h"
#include "search/cached_evaluator.h"
#include "search/network.h"
#include "search/network_evaluator.h"
#include "search/symmetry_evaluator.h"
#include "tests/search/fake_network.h"
#include "tests/search/tictactoe.h"

namespace {

using search::Evaluation;
using search::Query;
using tictactoe::TicTacToe;

TEST(Answer, SoftmaxTellsWhatIsNoNumber) {
    std::vector<float> logits{1, 1, 1 + std::log(2.0f)};
    ASSERT_TRUE(search::softmax(logits));
    EXPECT_NEAR(logits[0], 0.25, 1e-6);
    EXPECT_NEAR(logits[2], 0.5, 1e-6);
    std::vector<float> bad{1, std::numeric_limits<float>::quiet_NaN()};
    EXPECT_FALSE(search::softmax(bad));
    std::vector<float> endless{1, std::numeric_limits<float>::infinity()};
    EXPECT_FALSE(search::softmax(endless));
}

TEST(Answer, WithoutDrawsTheRestIsNormalised) {
    const std::array<float, 3> logits{0, 5, 0};
    Evaluation answer;
    ASSERT_TRUE(search::set_outcomes(logits, false, answer));
    EXPECT_FLOAT_EQ(answer.win, 0.5f);
    EXPECT_FLOAT_EQ(answer.draw, 0);
    ASSERT_TRUE(search::set_outcomes(logits, true, answer));
    EXPECT_GT(answer.draw, 0.9f);
}

TEST(Answer, TheScoreIsTheLeadOfANetworkWithoutAWordOnThat) {
    using search::Figure;
    nn::TowerDescription tower;
    tower.facts = {.game = "go", .encoding = "katago-v7", .board = 0, .blocks = 1, .channels = 8};
    tower.planes = 22;
    tower.globals = 19;
    tower.policy = nn::PolicyHead::points;
    tower.flat_value = false;
    tower.wdl = tower.ownership = tower.score = true;
    engine::Random random(1);
    const search::OutputMap map(nn::build_tower(tower, random));
    const auto at = [&](Figure figure) { return map.figures[static_cast<std::size_t>(figure)]; };
    ASSERT_TRUE(at(Figure::score));
    EXPECT_EQ(at(Figure::lead), at(Figure::score));
    EXPECT_FALSE(at(Figure::score_deviation));
}

TEST(Answer, EverySymmetryIsAPermutation) {
    std::vector<int> seen(25);
    for (int symmetry = 0; symmetry < 8; ++symmetry)
        for (std::size_t point = 0; point < 25; ++point)
            ++seen[search::turned_point(point, 5, symmetry)];
    EXPECT_EQ(seen, std::vector<int>(25, 8));
    EXPECT_EQ(search::turned_point(1, 5, 4), 5u);   // (1, 0) -> (0, 1)
    EXPECT_EQ(search::turned_point(0, 5, 2), 4u);   // left to right
    EXPECT_EQ(search::turned_point(0, 5, 1), 20u);  // top to bottom
}

Evaluation ask(search::Evaluator<TicTacToe>& evaluator, const TicTacToe& game, int symmetry = 0) {
    Evaluation answer;
    const auto moves = game.legal_moves();
    const Query<TicTacToe> query{&game, &moves, symmetry, &answer};
    evaluator.evaluate({&query, 1});
    return answer;
}

TEST(Symmetry, AveragesOverAll) {
    auto fake = std::make_unique<fake::Network>();
    auto* const counts = fake.get();
    fake->symmetric = 8;
    search::SymmetryEvaluator<TicTacToe> evaluator(std::move(fake), 1);
    const auto answer = ask(evaluator, TicTacToe(), search::all_symmetries);
    EXPECT_EQ(counts->asked, 8);
    EXPECT_EQ(counts->seen, (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7}));
    // The fake wins by a tenth of the symmetry's number.
    EXPECT_NEAR(answer.win, 0.35, 1e-6);
    EXPECT_NEAR(answer.priors[0], 1.0 / 9, 1e-6);
}

TEST(Symmetry, DrawsEachForEveryQuestion) {
    auto fake = std::make_unique<fake::Network>();
    auto* const counts = fake.get();
    fake->symmetric = 8;
    search::SymmetryEvaluator<TicTacToe> evaluator(std::move(fake), 1);
    std::vector<int> seen(8);
    for (int i = 0; i < 200; ++i) ask(evaluator, TicTacToe(), search::random_symmetry);
    for (const int symmetry : counts->seen) ++seen.at(static_cast<std::size_t>(symmetry));
    for (const int count : seen) EXPECT_GT(count, 8);
}

TEST(Symmetry, GamesWithoutAreAskedAsTheyStand) {
    auto fake = std::make_unique<fake::Network>();
    auto* const counts = fake.get();
    search::SymmetryEvaluator<TicTacToe> evaluator(std::move(fake), 1);
    ask(evaluator, TicTacToe(), search::all_symmetries);
    ask(evaluator, TicTacToe(), search::random_symmetry);
    EXPECT_EQ(counts->seen, (std::vector<int>{0, 0}));
}

TEST(Cache, AnswersOnceForTheSameQuestion) {
    auto fake = std::make_unique<fake::Network>();
    auto* const counts = fake.get();
    search::CachedEvaluator<TicTacToe> evaluator(
        std::move(fake), std::make_shared<search::EvaluationCache>(1 << 20));
    const auto first = ask(evaluator, TicTacToe());
    const auto again = ask(evaluator, TicTacToe());
    EXPECT_EQ(counts->asked, 1);
    EXPECT_EQ(first.win, again.win);
    ASSERT_EQ(first.priors.size(), again.priors.size());
    EXPECT_NEAR(first.priors[0], again.priors[0], 1e-3);
    ask(evaluator, TicTacToe(), 3);
    EXPECT_EQ(counts->asked, 2) << "another symmetry is another question";
    ask(evaluator, TicTacToe::from_text("5"));
    EXPECT_EQ(counts->asked, 3);
}

Evaluation numbered(std::uint64_t number) {
    Evaluation made;
    made.win = static_cast<float>(number % 97) / 97;
    made.loss = 1 - made.win;
    made.figures.fill(static_cast<float>(number));
    made.priors.assign(number % 40 + 1, 1 / static_cast<float>(number % 40 + 1));
    made.owners.assign(number % 17, made.win);
    return made;
}

// What other threads overwrite meanwhile is missed, never mixed.
TEST(Cache, NeverMixesAnswersOfSeveralThreads) {
    search::EvaluationCache cache(20000);
    std::atomic<int> hits = 0, wrong = 0;
    const auto work = [&](std::uint64_t seed) {
        engine::Random random(seed);
        Evaluation found;
        for (int i = 0; i < 20000; ++i) {
            const auto number = random() % 500;
            const auto key = engine::mixed(7, number);
            if (!cache.load(key, found)) {
                cache.store(key, numbered(number));
                continue;
            }
            ++hits;
            const auto expected = numbered(number);
            if (found.win != expected.win || found.priors.size() != expected.priors.size() ||
                found.owners.size() != expected.owners.size() || found.figures != expected.figures)
                ++wrong;
        }
    };
    std::thread other(work, 1);
    work(2);
    other.join();
    EXPECT_GT(hits, 100);
    EXPECT_EQ(wrong, 0);
}

template <class G>
G after(G game, std::initializer_list<const char*> moves) {
    for (const char* move : moves) game.play(*game.move_from_text(move));
    return game;
}

// Keys of one game by each encoding.
template <class G>
std::vector<std::uint64_t> keys(const G& game) {
    std::vector<std::uint64_t> all;
    for (const auto& encoding : G::encodings()) all.push_back(encoding.key(game));
    return all;
}

// How many encodings tell the two apart.
template <class G>
std::size_t telling_apart(const G& one, const G& other) {
    const auto first = keys(one), second = keys(other);
    std::size_t count = 0;
    for (std::size_t i = 0; i < first.size(); ++i) count += first[i] != second[i] ? 1u : 0u;
    return count;
}

TEST(Keys, TellHistoryKomiAndRulesApart) {
    const auto one = after(go::Go(9), {"C3", "D4", "E5"});
    auto other = after(go::Go(9), {"E5", "D4", "C3"});
    EXPECT_EQ(one.key(), other.key());
    EXPECT_EQ(telling_apart(one, other), go::Go::encodings().size()) << "history";
    other = one;
    EXPECT_EQ(telling_apart(one, other), 0u);
    other.set_komi(go::Komi::from_points(0.5));
    EXPECT_EQ(telling_apart(one, other), go::Go::encodings().size()) << "komi";
    other = one;
    other.set_rules(go::rules_from_text("japanese"));
    EXPECT_EQ(telling_apart(one, other), go::Go::encodings().size()) << "rules";
}

// All but "attacks", which looks at the present alone, and answers such positions from one place.
TEST(Keys, TellTheHistoryOfChessAndShogiApart) {
    const auto chess = after(chess::Chess(), {"g1f3", "g8f6", "b1c3"});
    const auto otherwise = after(chess::Chess(), {"b1c3", "g8f6", "g1f3"});
    EXPECT_EQ(telling_apart(chess, otherwise), chess::Chess::encodings().size() - 1);
    const auto attacks = engine::find_encoding<chess::Chess>("attacks").key;
    EXPECT_EQ(attacks(chess), attacks(otherwise));
    EXPECT_NE(attacks(chess), attacks(after(otherwise, {"f6g8", "c3b1", "g8f6", "b1c3"})))
        << "repetition";
    const auto shogi = after(shogi::Shogi(), {"7g7f", "3c3d", "2g2f"});
    const auto otherwise_shogi = after(shogi::Shogi(), {"2g2f", "3c3d", "7g7f"});
    EXPECT_EQ(telling_apart(shogi, otherwise_shogi), shogi::Shogi::encodings().size() - 1);
    const auto shogi_attacks = engine::find_encoding<shogi::Shogi>("attacks").key;
    EXPECT_EQ(shogi_attacks(shogi), shogi_attacks(otherwise_shogi));
}

template <class G>
class Sources : public testing::Test {};
using SourceGames = testing::Types<go::Go, chess::Chess, shogi::Shogi>;
TYPED_TEST_SUITE(Sources, SourceGames, );

// A position and the answers to it in a batch and alone.
template <class G>
struct Asked {
    G game;
    engine::MoveList moves = game.legal_moves();
    Evaluation together{}, alone{};
};

double sum_of_priors(const Evaluation& answer) {
    double sum = 0;
    for (const float prior : answer.priors) sum += static_cast<double>(prior);
    return sum;
}

template <class G>
void check_alone(search::Evaluator<G>& evaluator, Asked<G>& one) {
    const Query<G> query{&one.game, &one.moves, 0, &one.alone};
    evaluator.evaluate({&query, 1});
    EXPECT_EQ(one.alone.priors, one.together.priors);
    EXPECT_EQ(one.alone.win, one.together.win);
    EXPECT_NEAR(sum_of_priors(one.alone), 1, 1e-5);
    EXPECT_NEAR(one.alone.win + one.alone.draw + one.alone.loss, 1, 1e-5);
}

// A random network answers in every game, alike for one position and for a batch.
TYPED_TEST(Sources, AnswerInBatches) {
    const search::NetworkSource<TypeParam> source(
        std::make_shared<search::Network>(fake::small_network<TypeParam>(), nn::Precision::fp32));
    const auto evaluator = source.make_evaluator();
    TypeParam game;
    std::vector<Asked<TypeParam>> asked{{game}};
    game.play(game.legal_moves()[3]);
    asked.push_back({game});
    const std::vector<Query<TypeParam>> queries{
        {&asked[0].game, &asked[0].moves, 0, &asked[0].together},
        {&asked[1].game, &asked[1].moves, 0, &asked[1].together}};
    evaluator->evaluate(queries);
    check_alone(*evaluator, asked[0]);
    check_alone(*evaluator, asked[1]);
    EXPECT_NE(asked[0].alone.priors, asked[1].alone.priors);
}

int batch_of(const nn::Graph& graph, int board) {
    return search::NetworkSource<go::Go>(
               std::make_shared<search::Network>(graph, nn::Precision::fp32))
        .batch(go::Go(board));
}

TEST(Sources, AskForBatchesWhereTheyPay) {
    const auto small = fake::small_network<go::Go>();
    EXPECT_EQ(batch_of(small, 7), 8);
    EXPECT_EQ(batch_of(small, 9), 7);
    EXPECT_EQ(batch_of(small, 13), 3);
    EXPECT_EQ(batch_of(small, 19), 1);
    // 1.1 GFLOP a position, for which a search told to stop would have to wait.
    EXPECT_EQ(batch_of(fake::small_network<go::Go>(10, 192), 9), 3);
}

template <class Action>
std::string message_of(Action action) {
    try {
        action();
    } catch (const engine::Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(Sources, NamesBothWhereTheGameOrTheBoardIsWrong) {
    const auto network =
        std::make_shared<search::Network>(fake::small_network<chess::Chess>(), nn::Precision::fp32);
    EXPECT_EQ(message_of([&] { search::NetworkSource<go::Go> wrong(network); }),
              "the network random plays chess, not go");
    auto graph = fake::small_network<go::Go>();
    graph.facts.board = 19;
    const search::NetworkSource<go::Go> source(
        std::make_shared<search::Network>(graph, nn::Precision::fp32));
    EXPECT_EQ(message_of([&] { source.check(go::Go(19)); }), "no error");
    EXPECT_EQ(message_of([&] { source.check(go::Go(9)); }),
              "the network random is for boards of 19x19, not 9x9");
}

// Turning the board turns the answer with it.
TEST(Sources, GoNetworksSeeTheTurnedBoard) {
    const search::NetworkSource<go::Go> source(
        std::make_shared<search::Network>(fake::small_network<go::Go>(), nn::Precision::fp32));
    const auto evaluator = source.make_evaluator();
    go::Go game(9), turned(9);
    for (const auto& point : {go::Point{2, 3}, go::Point{6, 6}, go::Point{1, 5}}) {
        game.play(game.move_at(point));
        turned.play(turned.move_at({8 - point.x, point.y}));
    }
    const auto moves = game.legal_moves(), turned_moves = turned.legal_moves();
    Evaluation one, other;
    const Query<go::Go> as_seen{&game, &moves, 2, &one}, as_is{&turned, &turned_moves, 0, &other};
    evaluator->evaluate({&as_seen, 1});
    evaluator->evaluate({&as_is, 1});
    EXPECT_NEAR(one.win, other.win, 1e-6);
    for (int i = 0; i < moves.size(); ++i) {
        const auto point = game.point_of(moves[i]);
        const auto there = point ? turned.move_at({8 - point->x, point->y}) : go::Go::pass;
        std::size_t j = 0;
        while (turned_moves[static_cast<int>(j)] != there) ++j;
        EXPECT_NEAR(one.priors[static_cast<std::size_t>(i)], other.priors[j], 1e-6);
    }
}

TEST(Weights, AMissNamesEveryPathTried) {
    const auto text = message_of([] { search::find_weights("no-such-net.gz"); });
    const auto here = (std::filesystem::current_path() / "no-such-net.gz").string();
    EXPECT_NE(text.find(here), std::string::npos) << text;
    EXPECT_NE(text.find("sanban/no-such-net.gz"), std::string::npos) << text;
}

}  // namespace
