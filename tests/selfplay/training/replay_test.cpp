// The replay memory: what it keeps, what it leaves out, and that every position has its chance.
#include "selfplay/training/replay.h"

#include <gtest/gtest.h>

#include <map>

#include "engine/games.h"
#include "nn/training/learner.h"
#include "random_record.h"
#include "selfplay/training/journal.h"
#include "selfplay/training/learn_settings.h"
#include "selfplay/training/network_settings.h"

namespace selfplay::training {
namespace {

using nn::training::Loss;
using nn::training::Term;

records::Game blank(std::size_t turns) {
    records::Game game;
    game.turns.resize(turns);
    return game;
}

std::vector<std::uint16_t> first_turns(int count) {
    std::vector<std::uint16_t> turns;
    for (int i = 0; i < count; ++i) turns.push_back(static_cast<std::uint16_t>(i));
    return turns;
}

TEST(Pool, EveryPositionIsAsLikely) {
    Pool pool;
    for (const int turns : {1, 3, 12, 4}) pool.add(blank(20), 9, first_turns(turns));
    engine::Random random(1);
    std::map<std::pair<const records::Game*, std::size_t>, int> seen;
    constexpr int draws = 40000;
    for (const auto& place : pool.draw(9, draws, random)) ++seen[{place.game, place.turn}];
    ASSERT_EQ(seen.size(), 20u);
    // Six deviations of a count whose mean is 2000.
    for (const auto& [place, count] : seen) EXPECT_NEAR(count, draws / 20, 6 * 44);
}

TEST(Pool, BoardsOfOneSideAtATime) {
    Pool pool;
    pool.add(blank(4), 9, first_turns(4));
    pool.add(blank(12), 7, first_turns(12));
    engine::Random random(1);
    int small = 0;
    for (int i = 0; i < 4000; ++i) small += pool.draw_side(random) == 7;
    EXPECT_NEAR(small, 3000, 6 * 28);
    pool.drop_oldest();
    EXPECT_EQ(pool.games(), 1u);
    EXPECT_EQ(pool.positions(), 12u);
    EXPECT_EQ(pool.draw_side(random), 7);
}

TEST(Replay, TheWindowGrowsByTheLaw) {
    const ReplaySettings law{.window = 1000, .window_exponent = 0.75f, .window_factor = 0.4f};
    EXPECT_EQ(window_of(law, 10), 1000u);
    EXPECT_EQ(window_of(law, 1000), 1000u);
    EXPECT_NEAR(static_cast<double>(window_of(law, 16000)), 1000 * (1 + 0.4 * 7 / 0.75), 2);
}

TEST(Replay, TheOldestGamesGo) {
    const ReplaySettings fixed{.window = 10, .window_factor = 0, .held_out = 0};
    Replay<go::Go> replay(fixed, "alphazero", 1);
    for (std::uint64_t i = 1; i <= 30; ++i)
        EXPECT_TRUE(replay.add(random_record(go::Go(5), i, 10), i));
    EXPECT_EQ(replay.lessons().games(), 10u);
    EXPECT_EQ(replay.lessons().newest()->steps, 30u);
}

TEST(Replay, LeavesOutWhatCannotBePlayedOrTeachesNothing) {
    Replay<go::Go> replay({}, "alphazero", 1);
    auto illegal = random_record(go::Go(5), 1, 10);
    illegal.turns[3].move = illegal.turns[2].move;
    EXPECT_FALSE(replay.add(illegal, 1));
    EXPECT_FALSE(replay.add(random_record(chess::Chess(), 1, 10), 1));
    auto silent = random_record(go::Go(5), 1, 10);
    for (auto& turn : silent.turns) turn.share_count = 0;
    EXPECT_FALSE(replay.add(silent, 1));
    EXPECT_EQ(replay.games(), 0u);
}

TEST(Replay, TheSameGamesAreHeldOutAgain) {
    const ReplaySettings half{.held_out = 0.5f};
    Replay<go::Go> one(half, "alphazero", 1), other(half, "alphazero", 2);
    for (std::uint64_t i = 0; i < 40; ++i) {
        const auto record = random_record(go::Go(5), i, 6);
        one.add(record, i);
        other.add(record, i + 100);
    }
    EXPECT_GT(one.held_out().games(), 8u);
    EXPECT_LT(one.held_out().games(), 32u);
    EXPECT_EQ(one.held_out().games(), other.held_out().games());
}

// Of a game that Black won, on 5x5, with 17 planes.
void expect_black_won(const nn::training::Samples& samples, std::size_t i) {
    const bool black = samples.inputs[0][(i * 17 + 16) * 25] == 1;
    const auto outcome = samples.targets[1].numbers.subspan(3 * i, 3);
    EXPECT_EQ(outcome[0], black ? 1 : 0);
    EXPECT_EQ(outcome[2], black ? 0 : 1);
    const auto& policy = samples.targets[0];
    float sum = 0;
    for (auto m = policy.starts[i]; m < policy.starts[i + 1]; ++m)
        sum += policy.numbers[static_cast<std::size_t>(m)];
    EXPECT_NEAR(sum, 1, 1e-5);
}

TEST(Replay, BatchesHoldTheLessonsOfTheirPositions) {
    ReplaySettings plain{.held_out = 0, .symmetries = false};
    Replay<go::Go> replay(plain, "alphazero", 2);
    auto record = random_record(go::Go(5), 1, 20, 3);
    record.outcome = engine::Outcome::first_wins;
    replay.add(record, 1);
    const std::vector<Term> terms = {{"policy", Loss::policy, 1},
                                     {"wdl", Loss::distribution, 1},
                                     {"ownership", Loss::ownership, 1},
                                     {"score", Loss::score, 1}};
    engine::Random random(1);
    const auto& samples = replay.draw(8, terms, random);
    EXPECT_EQ(samples.size, 8);
    EXPECT_EQ(samples.board, 5);
    ASSERT_EQ(samples.inputs[0].size(), 8u * 17 * 25);
    ASSERT_EQ(samples.targets[0].starts.size(), 9u);
    for (std::size_t i = 0; i < 8; ++i) expect_black_won(samples, i);
    EXPECT_EQ(samples.targets[2].numbers.size(), 8u * 25);
}

template <class G>
struct LearningOf : testing::Test {};
using Games = testing::Types<go::Go, chess::Chess, shogi::Shogi>;
TYPED_TEST_SUITE(LearningOf, Games);

// A network that cannot learn one batch by heart is wired wrongly somewhere.
TYPED_TEST(LearningOf, OneBatchIsLearnedByHeart) {
    ReplaySettings plain{.held_out = 0, .symmetries = false};
    Replay<TypeParam> replay(plain, "alphazero", 1);
    TypeParam start;
    if constexpr (std::is_same_v<TypeParam, go::Go>) start = go::Go(5);
    for (std::uint64_t i = 0; i < 4; ++i) {
        auto record = random_record(start, i, 12);
        record.outcome = i % 2 == 0 ? engine::Outcome::first_wins : engine::Outcome::second_wins;
        for (auto& share : record.shares)  // one move has it all
            share.share =
                &share - record.shares.data() == record.turns[0].first_share ? 65535 : share.share;
        replay.add(record, i);
    }
    engine::Random random(1);
    const auto shape = engine::find_encoding<TypeParam>("alphazero").shape(start);
    NetworkSettings network{.blocks = 1, .channels = 16};
    const auto graph = new_network(network, TypeParam::name, shape, random);
    LearnSettings learn{.batch = 32, .warm_up = 0};
    learn.numbers = Numbers::fp32;
    nn::training::Learner learner(graph, learner_settings(learn, graph, 1));
    const auto& samples = replay.draw(32, learner.terms(), random);
    QualityTally before, after;
    before.add(learner.step(samples), learner.terms(), 32);
    for (int i = 0; i < 60; ++i) learner.step(samples);
    after.add(learner.step(samples), learner.terms(), 32);
    EXPECT_LT(after.mean().value_error, before.mean().value_error / 4);
    EXPECT_LT(after.mean().policy_loss, before.mean().policy_loss);
}

}  // namespace
}  // namespace selfplay::training
