// The gate and the ladder, with networks that know nothing of the game and differ in how gladly
// they pass.
#include <gtest/gtest.h>

#include "engine/base/files.h"
#include "nn/compose.h"
#include "nn/load.h"
#include "selfplay/training/ladder.h"
#include "tests/temporary_folder.h"

namespace selfplay::training {
namespace {

// Every position is even to it, and every point alike; a pass has the logit `pass`.
nn::Graph ignorant(float pass_logit) {
    constexpr int planes = 17;
    nn::Graph graph;
    graph.facts.game = "go";
    graph.facts.encoding = "alphazero";
    graph.facts.name = "ignorant";
    const int x = nn::add_input(graph, "planes", {planes, true});
    const int even = nn::add_convolution(graph, "even", x,
                                         {{{1, planes, 1, 1}, std::vector<float>(planes, 0.0f)}});
    const int mean = nn::add_pool(graph, "mean", even, nn::Pooling::mean);
    nn::name_output(graph, "value",
                    nn::add_activation(graph, "value.tanh", mean, nn::Activation::tanh));
    const int pass = nn::add_dense(graph, "pass", mean, {{{1, 1}, {0.0f}}, {{1}, {pass_logit}}});
    const int flat = nn::add_operation(graph, nn::Operation::flatten, "flat", {even});
    nn::name_output(
        graph, "policy",
        nn::add_operation(graph, nn::Operation::concatenate, "policy.all", {flat, pass}));
    nn::validate(graph);
    return graph;
}

struct Arena : testing::Test {
    tests::TemporaryFolder temporary;
    Settings settings = preset_settings("alphagozero", "go", 5);
    std::filesystem::path eager = temporary.path() / "eager.safetensors";
    std::filesystem::path tired = temporary.path() / "tired one.safetensors";

    Arena() {
        set_setting(settings, "komi", "0.5");
        set_setting(settings, "precision", "fp32");
        set_setting(settings, "gate-simulations", "12");
        nn::save(ignorant(-4), eager);
        nn::save(ignorant(8), tired);
    }
};

TEST_F(Arena, TheGateIsThePapers) {
    EXPECT_EQ(settings.run.gate_games, 400);
    EXPECT_FLOAT_EQ(settings.run.gate_score, 0.55f);
}

TEST_F(Arena, TheGatePlaysAllItsGamesAndJudgesByTheirScore) {
    set_setting(settings, "gate-games", "20");
    const auto verdict = judge(settings, tired, eager, 1, {});
    EXPECT_EQ(verdict.tally.games(), 20);
    EXPECT_EQ(verdict.passed, verdict.tally.score() > 0.55);
}

// One network before and after six minutes of `train --size 5 --blocks 2 --channels 12 --komi 0.5`.
TEST_F(Arena, TheGateLetsTheBetterNetworkPassAndNotTheWorse) {
    const auto folder =
        std::filesystem::path(SANBAN_SOURCE_DIR) / "tests/selfplay/training/networks";
    const auto untaught = folder / "go5_untaught.safetensors";
    const auto taught = folder / "go5_taught.safetensors";
    set_setting(settings, "gate-games", "40");
    const auto better = judge(settings, untaught, taught, 2, {});
    EXPECT_TRUE(better.passed);
    EXPECT_GT(better.tally.score(), 0.9);
    EXPECT_FALSE(judge(settings, taught, untaught, 2, {}).passed);
    // At the paper's 55 %, what is no better does not pass by playing well.
    EXPECT_LT(judge(settings, taught, taught, 2, {}).tally.score(), 0.8);
}

TEST_F(Arena, AGateThatIsInterruptedLetsNothingPass) {
    std::stop_source stop;
    stop.request_stop();
    EXPECT_FALSE(judge(settings, tired, eager, 1, stop.get_token()).passed);
}

TEST_F(Arena, TheLadderKeepsNetworksAndResults) {
    const RunFolder folder(temporary.path() / "run");
    std::filesystem::copy_file(eager, folder.latest());
    set_setting(settings, "ladder-simulations", "8");
    {
        Ladder ladder(folder, settings, 1);
        EXPECT_TRUE(ladder.wants_snapshot(0));
        ladder.keep(100, 60);
        EXPECT_FALSE(ladder.wants_snapshot(70));
        EXPECT_TRUE(ladder.wants_snapshot(60 + 30 * 60));
        ladder.measure({}, 60);
        ASSERT_NE(ladder.newest(), nullptr);
        EXPECT_EQ(ladder.newest()->games, 2);
    }
    const Ladder again(folder, settings, 1);
    ASSERT_NE(again.newest(), nullptr);
    EXPECT_EQ(again.newest()->name, "step 100");
    EXPECT_EQ(again.newest()->games, 2);
    EXPECT_EQ(again.newest()->seconds, 60);
    EXPECT_GT(again.newest()->strength.deviation, 0);
}

TEST_F(Arena, TheLadderPassesOverAnOpponentThatWouldTakeTooLong) {
    const RunFolder folder(temporary.path() / "run");
    std::filesystem::copy_file(eager, folder.latest());
    set_setting(settings, "ladder-simulations", "8");
    {
        Ladder ladder(folder, settings, 1);
        ladder.keep(10, 30);
        ladder.keep(50, 60);
    }
    // As strong as step 10, by whom it would be measured best.
    engine::append_file(folder.ladder(),
                        R"({"a":"step 50","b":"UCT 1000","wins":8,"draws":0,"losses":0,"took":0.8}
{"a":"step 50","b":"step 10","wins":4,"draws":0,"losses":4,"took":800}
{"a":"step 50","b":"UCT 10000","wins":0,"draws":0,"losses":8,"took":80000}
)");
    const auto games_of = [](const Ladder& ladder, std::string_view name) {
        return std::ranges::find(ladder.rungs(), name, &Rung::name)->games;
    };
    {
        Ladder ladder(folder, settings, 1);
        ladder.measure({}, 199);
        EXPECT_EQ(games_of(ladder, "UCT 1000"), 10);
    }
    Ladder again(folder, settings, 1);
    EXPECT_EQ(again.rungs().front().timed_games, 10);
    again.measure({}, 201);
    EXPECT_EQ(games_of(again, "step 10"), 10);
    // Of which nothing is known but that it has more simulations than what takes too long.
    EXPECT_EQ(games_of(again, "UCT 100000"), 0);
}

}  // namespace
}  // namespace selfplay::training
