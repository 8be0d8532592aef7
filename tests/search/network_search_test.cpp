// Search with networks, on a toy game whose network the test writes itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "search/searcher.h"
#include "tests/search/fake_network.h"
#include "tests/search/tictactoe.h"

namespace search {
namespace {

using tictactoe::TicTacToe;
using Answer = std::function<void(const Query<TicTacToe>&)>;

// Games played out that all end alike.
class FirstWins final : public RolloutPlayer<TicTacToe> {
   public:
    engine::RolloutResult play(const TicTacToe&, engine::Random&) override {
        return {engine::Outcome::first_wins, 0, {}, {}};
    }
    void weigh(const TicTacToe&, const engine::MoveList&, std::vector<float>&) const override {}
};

// Games of which three in four, in turn, are the first player's.
class ThreeOfFour final : public RolloutPlayer<TicTacToe> {
   public:
    engine::RolloutResult play(const TicTacToe&, engine::Random&) override {
        const bool first = ++played_ % 4 != 0;
        return {first ? engine::Outcome::first_wins : engine::Outcome::second_wins, 0, {}, {}};
    }
    void weigh(const TicTacToe&, const engine::MoveList&, std::vector<float>&) const override {}

   private:
    int played_ = 0;
};

class Source final : public EvaluatorSource<TicTacToe> {
   public:
    explicit Source(Answer answer) : answer_(std::move(answer)) {}
    std::unique_ptr<Evaluator<TicTacToe>> make_evaluator() const override {
        auto made = std::make_unique<fake::Network>();
        made->answer = answer_;
        made->batches = batches;
        return made;
    }
    std::unique_ptr<RolloutPlayer<TicTacToe>> make_rollouts() const override {
        if (mixed) return std::make_unique<ThreeOfFour>();
        return std::make_unique<FirstWins>();
    }
    float rollout_share() const override { return share; }
    int batch(const TicTacToe&) const override { return 4; }
    std::string_view name() const override { return "fake"; }
    void check(const TicTacToe&) const override {}
    int policy_index(const TicTacToe&, engine::Move move) const override { return move.code; }

    float share = 0;
    bool mixed = false;                           // how games played out end
    std::vector<std::size_t>* batches = nullptr;  // gets how many were asked about at once

   private:
    Answer answer_;
};

// Knows nothing: even priors, even value.
void even(const Query<TicTacToe>& query) { query.answer->win = query.answer->loss = 0.5f; }

SearchParams small() {
    SearchParams params;
    params.memory_mib = 16;
    params.early_end = false;
    return params;
}

Analysis searched_by(std::shared_ptr<const Source> source, const SearchParams& params,
                     std::string_view moves, std::uint64_t count) {
    Searcher<TicTacToe> searcher(params);
    searcher.set_network(std::move(source));
    searcher.set_position(TicTacToe::from_text(moves));
    Limits limits;
    limits.simulations = count;
    return searcher.think(limits);
}

Analysis searched(const SearchParams& params, std::string_view moves, std::uint64_t count,
                  const Answer& answer = even, float share = 0) {
    const auto source = std::make_shared<Source>(answer);
    source->share = share;
    return searched_by(source, params, moves, count);
}

Move cell(int number) { return {static_cast<std::uint16_t>(number - 1)}; }

TEST(Puct, TakesAWinInOneAndBlocksALoss) {
    EXPECT_EQ(searched(small(), "1425", 300).moves.at(0).move, cell(3));
    EXPECT_EQ(searched(small(), "152", 300).moves.at(0).move, cell(3));
}

TEST(Puct, OneVisitShowsThePriors) {
    const auto picture = searched(small(), "", 1, [](const auto& query) {
        even(query);
        query.answer->priors.assign(9, 0.05f);
        query.answer->priors[6] = 0.6f;
        query.answer->win = 0.7f;
        query.answer->loss = 0.3f;
    });
    EXPECT_EQ(picture.visits, 1u);
    EXPECT_NEAR(picture.value, 0.4, 1e-6);
    EXPECT_EQ(picture.moves.at(0).move, cell(7));
    EXPECT_NEAR(picture.moves.at(0).prior, 0.6, 1e-3);
}

// Of a root visited once, by a network that gives its mover 0.4.
float blended_value(float share, float lambda, std::string_view moves) {
    auto params = small();
    params.lambda = lambda;
    const auto answer = [](const Query<TicTacToe>& query) {
        query.answer->win = 0.7f;
        query.answer->loss = 0.3f;
    };
    return searched(params, moves, 1, answer, share).value;
}

TEST(Puct, LeavesArePlayedOutAsSuitsTheNetworkUnlessToldOtherwise) {
    EXPECT_NEAR(blended_value(0, -1, ""), 0.4f, 1e-6f);
    EXPECT_NEAR(blended_value(0.25f, -1, ""), 0.75f * 0.4f + 0.25f, 1e-6f);
    EXPECT_NEAR(blended_value(0.25f, -1, "5"), 0.75f * 0.4f - 0.25f, 1e-6f);
    EXPECT_NEAR(blended_value(0.25f, 0, ""), 0.4f, 1e-6f);
    EXPECT_NEAR(blended_value(0, 1, "5"), -1, 1e-6f);
}

TEST(Puct, TheMeanOfALeafsRolloutsCounts) {
    const auto source = std::make_shared<Source>(even);
    source->mixed = true;
    for (const auto& [rollouts, mean] : {std::pair(1, 1.0f), std::pair(4, 0.5f)}) {
        auto params = small();
        params.lambda = 0.5f;
        params.rollouts = rollouts;
        EXPECT_NEAR(searched_by(source, params, "", 1).value, 0.5f * mean, 1e-6f) << rollouts;
    }
}

// With equal values, visits follow the priors.
TEST(Puct, VisitsFollowThePriors) {
    const auto lean = [](const Query<TicTacToe>& query) {
        even(query);
        const auto count = query.answer->priors.size();
        query.answer->priors.assign(count, 0.5f / static_cast<float>(count - 1));
        query.answer->priors[0] = 0.5f;
    };
    const auto picture = searched(small(), "", 100, lean);
    EXPECT_EQ(picture.moves.at(0).move, cell(1));
    EXPECT_NEAR(static_cast<double>(picture.moves.at(0).visits), 50, 12);
}

TEST(Puct, AnUnvisitedMoveIsWorthItsParentLessTheReduction) {
    auto params = small();
    params.fpu_reduction = params.root_fpu_reduction = 10;
    // So bad is what is unvisited that the first move is searched alone.
    EXPECT_EQ(searched(params, "", 20).moves.at(1).visits, 0u);
    params.fpu_reduction = params.root_fpu_reduction = -10;
    EXPECT_GT(searched(params, "", 20).moves.at(8).visits, 0u);
}

TEST(Puct, BatchesCountEverySimulation) {
    for (const int batch : {1, 3, 8}) {
        auto params = small();
        params.batch = batch;
        const auto picture = searched(params, "152", 400);
        EXPECT_EQ(picture.simulations, 400u) << batch;
        EXPECT_EQ(picture.visits, 400u) << batch;
        EXPECT_EQ(picture.moves.at(0).move, cell(3)) << batch;
    }
}

std::vector<std::size_t> batches_of(int batch, std::uint64_t count) {
    std::vector<std::size_t> batches;
    const auto source = std::make_shared<Source>(even);
    source->batches = &batches;
    auto params = small();
    params.batch = batch;
    Searcher<TicTacToe> searcher(params);
    searcher.set_network(source);
    Limits limits;
    limits.simulations = count;
    searcher.think(limits);
    return batches;
}

// What the network asks for unless settings do, and less of it while the tree is small.
TEST(Puct, BatchesGrowWithTheTree) {
    const auto small_tree = batches_of(0, 12), automatic = batches_of(0, 400),
               six = batches_of(6, 400), one = batches_of(1, 400);
    EXPECT_EQ(std::ranges::max(small_tree), 1u);
    EXPECT_EQ(std::ranges::max(automatic), 4u);
    EXPECT_EQ(automatic.front(), 1u);
    EXPECT_EQ(std::ranges::max(six), 6u);
    EXPECT_EQ(std::ranges::max(one), 1u);
}

// A win that is found while leaves are gathered draws every further descent, none of which is a
// leaf: the search has to end in time all the same.
TEST(Puct, BatchesEndWhereAWinIsFound) {
    auto params = small();
    params.batch = 8;
    for (const std::string_view moves : {"", "1", "15", "12", "19", "152", "127", "195", "1952"}) {
        Searcher<TicTacToe> searcher(params);
        searcher.set_network(std::make_shared<Source>(even));
        searcher.set_position(TicTacToe::from_text(moves));
        Limits limits;
        limits.time = Milliseconds(200);
        EXPECT_GT(searcher.think(limits).visits, 0u) << moves;
    }
}

TEST(Puct, ThreadsCountEverySimulation) {
    auto params = small();
    params.threads = 4;
    params.batch = 4;
    const auto picture = searched(params, "152", 2000);
    EXPECT_EQ(picture.simulations, 2000u);
    EXPECT_EQ(picture.visits, 2000u);
}

TEST(Puct, OneSeedGivesOneTree) {
    const auto one = searched(small(), "5", 500), other = searched(small(), "5", 500);
    ASSERT_EQ(one.moves.size(), other.moves.size());
    for (std::size_t i = 0; i < one.moves.size(); ++i) {
        EXPECT_EQ(one.moves[i].move, other.moves[i].move);
        EXPECT_EQ(one.moves[i].visits, other.moves[i].visits);
    }
}

TEST(Network, UctPlaysOutEvenWhereThereIsANetwork) {
    auto params = small();
    params.method = Method::uct;
    int asked = 0;
    const auto picture = searched(params, "152", 500, [&](const auto& query) {
        ++asked;
        even(query);
    });
    EXPECT_EQ(asked, 0);
    EXPECT_EQ(picture.moves.at(0).move, cell(3));
}

TEST(Network, WhatItThrowsEndsTheThinkWithTheMessageAndTheMovesKnown) {
    int asked = 0;
    const auto picture = searched(small(), "5", 1000, [&](const auto& query) {
        even(query);
        if (++asked == 20) engine::fail("the network yields what is no number");
    });
    EXPECT_EQ(picture.fault, "the network yields what is no number");
    EXPECT_EQ(picture.moves.size(), 8u);
    EXPECT_LT(picture.simulations, 1000u);
}

TEST(Network, ThinksAgainAfterAFault) {
    Searcher<TicTacToe> searcher(small());
    bool broken = true;
    searcher.set_network(std::make_shared<Source>([&](const auto& query) {
        even(query);
        if (broken) engine::fail("broken");
    }));
    Limits limits;
    limits.simulations = 100;
    EXPECT_EQ(searcher.think(limits).fault, "broken");
    broken = false;
    const auto picture = searcher.think(limits);
    EXPECT_EQ(picture.fault, "");
    EXPECT_EQ(picture.visits, 100u);
}

}  // namespace
}  // namespace search
