// The stages of AlphaGo's training on boards of 5x5, in a temporary folder: each learns what its
// games show, goes on where it was stopped, and leaves files that can be read.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "nn/load.h"
#include "search/linear_network.h"
#include "search/load_player.h"
#include "selfplay/alphago/linear_learner.h"
#include "selfplay/alphago/policy_games.h"
#include "selfplay/alphago/policy_stage.h"
#include "selfplay/alphago/report.h"
#include "selfplay/alphago/rl_stage.h"
#include "selfplay/alphago/rollout_stage.h"
#include "selfplay/alphago/train.h"
#include "selfplay/alphago/value_stage.h"
#include "selfplay/records/segment.h"
#include "tests/engine/go_position.h"
#include "tests/temporary_folder.h"

namespace selfplay::alphago {
namespace {

namespace fs = std::filesystem;
using Lines = std::vector<nlohmann::json>;

// Games that all begin in the centre and go round it.
std::string spiral_games(int count) {
    std::string text;
    for (int i = 0; i < count; ++i) {
        text += "(;SZ[5]KM[0.5];B[cc]";
        text += i % 2 == 0 ? ";W[cb];B[bb];W[db];B[bd];W[dd];B[ac])\n"
                           : ";W[cd];B[dd];W[bd];B[db];W[bb];B[ec])\n";
    }
    return text;
}

struct Stage {
    tests::TemporaryFolder folder;
    Lines lines;
    StageInput input;

    Stage() {
        engine::write_file(folder.path() / "games.sgfs", spiral_games(40));
        input.records = {folder.path() / "games.sgfs"};
        input.folder = folder.path() / "stage";
        input.say = [](const std::string&) {};
        input.report = [this](const std::string& line) {
            lines.push_back(nlohmann::json::parse(line));
        };
    }
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;
    ~Stage() = default;
};

TEST(LinearLearner, ForetellsWhatItWasShown) {
    LinearLearner learner;
    const go::Go game(5);
    const auto centre = game.move_at({2, 2});
    go::Go next = game;
    next.play(centre);
    const auto beside = next.move_at({2, 3});
    for (int i = 0; i < 200; ++i) learner.learn(next, beside, 0.1f);
    learner.judge(next, beside);
    const auto quality = learner.take_quality();
    // All four sides look alike: a quarter each.
    for (const auto& policy : quality) EXPECT_NEAR(policy.loss, std::log(4), 0.1);
}

TEST(LinearLearner, AFileGoesOn) {
    const tests::TemporaryFolder folder;
    const go::Go game(5);
    LinearLearner one;
    for (int i = 0; i < 5; ++i) one.learn(game, game.move_at({1, 2}), 0.1f);
    one.save(folder.path() / "linear.safetensors");
    LinearLearner other;
    other.restore(folder.path() / "linear.safetensors");
    EXPECT_EQ(other.steps(), 5u);
    for (auto* learner : {&one, &other}) {
        learner->learn(game, game.move_at({3, 3}), 0.1f);
        learner->judge(game, game.move_at({2, 2}));
    }
    EXPECT_EQ(one.take_quality()[1].loss, other.take_quality()[1].loss);
    EXPECT_NE(search::linear_policies_of(nn::load(folder.path() / "linear.safetensors")), nullptr);
}

TEST(LinearLearner, RefusesAnotherNetwork) {
    const tests::TemporaryFolder folder;
    nn::save(new_policy({2, 4, 5}, 1), folder.path() / "policy.safetensors");
    EXPECT_THROW(LinearLearner().restore(folder.path() / "policy.safetensors"), engine::Error);
    EXPECT_THROW(search::linear_policies_of(nn::load(folder.path() / "policy.safetensors")),
                 engine::Error);
}

TEST(RolloutStage, LearnsAndGoesOn) {
    Stage stage;
    RolloutSettings settings;
    settings.size = 5;
    settings.least_moves = 3;
    settings.positions = 2000;
    learn_rollout(stage.input, settings, {});
    ASSERT_EQ(stage.lines.size(), 1u);
    EXPECT_GT(stage.lines[0]["tree_accuracy"], 0.5);
    EXPECT_GT(stage.lines[0]["rollout_accuracy"], 0.4);
    settings.positions = 2100;
    learn_rollout(stage.input, settings, {});
    EXPECT_GE(stage.lines[1]["positions"], 2100);
    EXPECT_LT(stage.lines[1]["positions"], 2200);
}

PolicySettings short_games() {
    PolicySettings settings;
    settings.least_moves = 3;
    settings.judged = 24;
    return settings;
}

training::LearnSettings fast_learning() {
    auto learning = policy_learning();
    learning.batch = 16;
    learning.rate = 0.01f;
    learning.warm_up = 0;
    learning.average = 0;
    return learning;
}

TEST(PolicyStage, LearnsAndGoesOn) {
    Stage stage;
    auto settings = short_games();
    const auto learning = fast_learning();
    for (const auto planes : {Planes::all, Planes::raw}) {
        stage.input.folder = stage.folder.path() / planes_names[static_cast<std::size_t>(planes)];
        const StageNetwork network{2, 8, 5, planes};
        stage.lines.clear();
        settings.steps = 150;
        learn_policy(stage.input, new_policy(network, 1), settings, learning, {});
        ASSERT_EQ(stage.lines.size(), 1u);
        EXPECT_GT(stage.lines[0]["held_out_accuracy"], 0.6);
        settings.steps = 151;
        learn_policy(stage.input, new_policy(network, 1), settings, learning, {});
        ASSERT_EQ(stage.lines.size(), 2u);
        EXPECT_EQ(stage.lines[1]["steps"], 151);
        EXPECT_GT(stage.lines[1]["held_out_accuracy"], 0.6);
        EXPECT_EQ(nn::load(stage.input.folder / "latest.safetensors").facts.steps, 151);
    }
}

// The paper's network plays, whether it was normed while it learned or not.
TEST(PolicyStage, LeavesNoNormsInTheNetworkThatPlays) {
    Stage stage;
    auto settings = short_games();
    for (const bool norms : {false, true}) {
        settings.norms = norms;
        settings.steps = 150;
        stage.input.folder = stage.folder.path() / (norms ? "normed" : "plain");
        learn_policy(stage.input, new_policy({2, 8, 5}, 1), settings, fast_learning(), {});
        EXPECT_GT(stage.lines.back()["held_out_accuracy"], 0.6);
        const auto plays = nn::load(stage.input.folder / "latest.safetensors");
        for (const auto& node : plays.nodes)
            EXPECT_NE(node.operation, nn::Operation::batch_norm) << node.name;
        // A pool of policies and a further folder go on from it as it is.
        stage.input.folder += "-further";
        settings.steps = 1;
        learn_policy(stage.input, plays, settings, fast_learning(), {});
        EXPECT_GT(stage.lines.back()["held_out_accuracy"], 0.6);
    }
}

TEST(PolicyStage, GoesOnFromAFileInAnotherFolder) {
    Stage stage;
    auto settings = short_games();
    settings.steps = 150;
    const auto learning = fast_learning();
    learn_policy(stage.input, new_policy({2, 8, 5}, 1), settings, learning, {});
    const auto learned = stage.input.folder / "latest.safetensors";
    stage.input.folder = stage.folder.path() / "further";
    settings.steps = 1;
    learn_policy(stage.input, policy_to_go_on_from(learned), settings, learning, {});
    EXPECT_EQ(stage.lines.back()["steps"], 1);
    EXPECT_GT(stage.lines.back()["held_out_accuracy"], 0.6);
    const auto value = stage.folder.path() / "value.safetensors";
    nn::save(new_value({2, 8, 5}, 1), value);
    EXPECT_THROW(policy_to_go_on_from(value), engine::Error);
}

TEST(PolicyStage, RefusesAFolderOfAnotherNetwork) {
    Stage stage;
    PolicySettings settings;
    settings.least_moves = 3;
    settings.steps = 1;
    settings.judged = 4;
    auto learning = policy_learning();
    learning.batch = 4;
    learn_policy(stage.input, new_policy({2, 8, 5}, 1), settings, learning, {});
    EXPECT_THROW(learn_policy(stage.input, new_policy({3, 8, 5}, 1), settings, learning, {}),
                 engine::Error);
}

fs::path saved_policy(const Stage& stage, std::uint64_t seed) {
    const auto path = stage.folder.path() / fmt::format("policy{}.safetensors", seed);
    nn::save(new_policy({2, 8, 5}, seed), path);
    return path;
}

TEST(PolicyGames, EndScoredAndMarked) {
    Stage stage;
    const Networks networks{playing_network(nn::load(saved_policy(stage, 1))),
                            playing_network(nn::load(saved_policy(stage, 2)))};
    const Plan plan{[](const Playing& playing) {
                        const int ply = playing.game.move_count();
                        return ply == 3 ? uniform_policy : ply % 2;
                    },
                    [](const Playing& playing) { return playing.game.move_count() == 4; }};
    nn::training::Workers one(1), two(2);
    const auto games = play_games(20, 5, 7, networks, plan, one);
    const auto same = play_games(20, 5, 7, networks, plan, two);
    ASSERT_EQ(games.size(), 20u);
    for (std::size_t i = 0; i < games.size(); ++i) {
        const auto& record = games[i].record;
        EXPECT_EQ(record, same[i].record);
        EXPECT_EQ(record.owners.size(), 25u);
        EXPECT_GT(record.turns.size(), 5u);
        for (std::size_t turn = 0; turn < record.turns.size(); ++turn)
            EXPECT_EQ(record.turns[turn].share_count, turn == 4 ? 1u : 0u);
        EXPECT_EQ(result_for(record, engine::Player::first),
                  -result_for(record, engine::Player::second));
    }
    EXPECT_NE(games[0].record, games[1].record);
}

TEST(RlStage, UpdatesSnapshotsAndGoesOn) {
    Stage stage;
    const auto policy = saved_policy(stage, 1);
    RlSettings settings;
    settings.games = 8;
    settings.updates = 2;
    settings.snapshot_updates = 2;
    settings.judge_games = 6;
    learn_rl(stage.input, policy, {}, settings, {});
    ASSERT_EQ(stage.lines.size(), 3u);
    EXPECT_EQ(stage.lines[1]["update"], 2);
    EXPECT_EQ(stage.lines[2]["games"], 6);
    const auto learned = nn::load(stage.input.folder / "latest.safetensors");
    EXPECT_EQ(learned.facts.steps, 2);
    EXPECT_NE(learned.nodes, nn::load(policy).nodes);
    EXPECT_TRUE(fs::exists(stage.input.folder / "snapshots" / "00000002.safetensors"));
    settings.updates = 3;
    nn::save(new_value({2, 8, 5}, 3), stage.folder.path() / "baseline.safetensors");
    learn_rl(stage.input, policy, stage.folder.path() / "baseline.safetensors", settings, {});
    EXPECT_EQ(stage.lines.back()["update"], 3);
}

TEST(RlStage, TeachesAmongTheSensibleMovesAlone) {
    const auto game = go::position({". X . X .",  //
                                    "X X X X X",  //
                                    ". . . . .",  //
                                    ". O . . .",  //
                                    ". . . . ."});
    training::Lesson lesson;
    std::vector<int> sensible;
    int place = 0;
    for (const auto move : game.legal_moves()) {
        if (move != go::Go::pass && !game.fills_own_eye(move)) sensible.push_back(place);
        lesson.moves.push_back(place);
        lesson.policy.push_back(static_cast<float>(place++));
    }
    keep_sensible(game, lesson);
    EXPECT_EQ(lesson.moves, sensible);
    EXPECT_EQ(sensible.size(), lesson.policy.size());
    EXPECT_EQ(place, 14 + 3 + 1);  // the open points, three eyes, the pass
    EXPECT_EQ(sensible.size(), 14u);
    for (std::size_t i = 0; i < sensible.size(); ++i)
        EXPECT_EQ(lesson.policy[i], static_cast<float>(sensible[i]));
}

// What wins is made likelier: a game that one move decides.
TEST(RlStage, TheSignOfALessonIsThatOfItsWeight) {
    Stage stage;
    const go::Go game(5);
    const auto centre = game.move_at({2, 2});
    records::Game record;
    record.game = "go";
    record.start = game.to_text();
    const float all = 1;
    record.add(centre, 0, 1, {&centre, 1}, {&all, 1});
    const auto& encoding = engine::find_encoding<go::Go>("alphago48");
    for (const float weight : {1.0f, -1.0f}) {
        nn::training::LearnerSettings settings;
        settings.optimiser.schedule.rate = 0.05f;
        nn::training::Learner learner(new_policy({2, 8, 5}, 1), settings);
        std::vector<training::Lesson> lessons(1);
        training::write_lesson(record, 0, encoding, 0, {}, lessons[0]);
        training::Batch judge, teach;
        judge.fill(lessons, 5, learner.terms());
        lessons[0].policy_weight = weight;
        teach.fill(lessons, 5, learner.terms());
        const auto before = learner.evaluate(judge.samples()).costs[0].mean_loss();
        for (int i = 0; i < 5; ++i) learner.step(teach.samples());
        const auto after = learner.evaluate(judge.samples()).costs[0].mean_loss();
        EXPECT_EQ(after<before, weight> 0);
    }
}

TEST(ValueStage, OnePositionAGameOrAll) {
    Stage stage;
    const ValuePlayers players{saved_policy(stage, 1), saved_policy(stage, 2)};
    ValueSettings settings;
    settings.games = 60;
    settings.steps = 3;
    settings.judged = 32;
    auto learning = policy_learning();
    learning.batch = 16;
    learn_value(stage.input, players, settings, learning, {});
    ASSERT_EQ(stage.lines.size(), 1u);
    EXPECT_GT(stage.lines[0]["test_error"], 0);
    std::size_t games = 0;
    for (const auto& path : records::Archive(stage.input.folder / "games").segments())
        for (const auto& game : records::unpack(engine::read_file(path)).games) {
            ++games;
            EXPECT_EQ(game.shares.size(), 1u);
        }
    EXPECT_GE(games, 60u);
    settings.positions = Taught::all;
    settings.pooled = 4;
    learn_value(stage.input, players, settings, learning, {});
    ASSERT_EQ(stage.lines.size(), 2u);
    EXPECT_EQ(stage.lines[1]["positions"], "all");
    const auto pools = [](const fs::path& file) {
        const auto nodes = nn::load(file).nodes;
        return std::any_of(nodes.begin(), nodes.end(), [](const nn::Node& node) {
            return node.operation == nn::Operation::pool;
        });
    };
    EXPECT_TRUE(pools(stage.input.folder / "all" / "latest.safetensors"));
    EXPECT_FALSE(pools(stage.input.folder / "latest.safetensors"));
    EXPECT_TRUE(nn::load(stage.input.folder / "latest.safetensors").output("value"));
}

TEST(ValueStage, LearnsFromGamesByOthersUponThePolicysLayers) {
    Stage stage;
    // Who begins in the centre wins, who begins elsewhere loses.
    std::string text;
    for (int i = 0; i < 40; ++i) {
        text += i % 2 == 0 ? "(;SZ[5]RE[B+R];B[cc]" : "(;SZ[5]RE[W+R];B[aa]";
        for (int ply = 0; ply < 32; ++ply) text += ply % 2 == 0 ? ";W[]" : ";B[]";
        text += ";W[bd])\n";
    }
    text += "(;SZ[5];B[cc];W[bb])\n";  // without a result
    engine::write_file(stage.input.records[0], text);
    const auto policy = policy_to_go_on_from(saved_policy(stage, 1));
    const auto fresh = value_upon(policy, 1);
    const auto weights_of = [](const nn::Graph& graph, std::string_view name) {
        for (const auto& node : graph.nodes)
            if (node.operation == nn::Operation::convolution && node.name == name)
                return node.weights[0].values;
        return std::vector<float>();
    };
    EXPECT_EQ(weights_of(fresh, "layer2"), weights_of(policy, "layer2"));
    EXPECT_FALSE(weights_of(fresh, "layer2").empty());
    ValueSettings settings;
    settings.steps = 400;
    settings.judged = 64;
    settings.positions = Taught::all;
    auto learning = policy_learning();
    learning.batch = 32;
    learning.rate = 0.003f;
    learning.warm_up = 0;
    learning.average = 0;
    learn_value_from_records(stage.input, fresh, settings, learning, {});
    ASSERT_EQ(stage.lines.size(), 1u);
    EXPECT_LT(stage.lines[0]["test_error"], 0.3) << stage.lines[0];
}

TEST(TrainAlphaGo, AllStagesMakeASetThatPlays) {
    Stage stage;
    TrainSettings settings;
    settings.rollout_positions = 100;
    settings.policy_steps = settings.rl_updates = settings.value_steps = 1;
    settings.rl_games = 4;
    settings.value_games = 20;
    // The games of the fixture are brief.
    std::string text;
    for (int i = 0; i < 20; ++i) {
        text += "(;SZ[5]";
        for (int ply = 0; ply < 32; ++ply) text += ply % 2 == 0 ? ";B[]" : ";W[]";
        text += ";B[cc])\n";
    }
    engine::write_file(stage.folder.path() / "games.sgfs", text);
    train_alphago(stage.input, {2, 4, 5}, settings, {});
    const auto set = stage.input.folder / "weights";
    EXPECT_NE(search::load_player(set.string(), nn::Precision::fp32, go::Go(5)), nullptr);
    const auto told = stage.lines.size();
    train_alphago(stage.input, {2, 4, 5}, settings, {});  // nothing is left to do
    EXPECT_EQ(stage.lines.size(), told);

    const auto page = engine::read_file(stage.input.folder / "report.html");
    for (const auto* part : {"AlphaGo on 5x5: policy of 2 layers of 4 filters", "1. Rollouts",
                             "2. Policy: loss", "3. Reinforced: length of games",
                             "4. Value: squared error", "held_out_accuracy", "rl-updates"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
    EXPECT_EQ(page.find("http"), std::string::npos);  // refers to nothing outside itself
}

TEST(TrainAlphaGo, TheReportLeavesOutWhatIsNotThere) {
    const tests::TemporaryFolder folder;
    const auto empty = report_html(folder.path(), "A & B", {});
    EXPECT_NE(empty.find("<h1>A &amp; B</h1>"), std::string::npos);
    EXPECT_EQ(empty.find("</svg>"), std::string::npos);
    std::filesystem::create_directories(folder.path() / "policy");
    engine::write_file(folder.path() / "policy" / "policy.jsonl",
                       R"({"stage": "policy", "minutes": 1, "held_out_accuracy": 0.25}
{"stage": "policy", "minutes": 2, "held_out_accuracy": 0.375}
{"stage": "policy", "minu)");
    const auto page = report_html(folder.path(), "torn", {});
    EXPECT_NE(page.find("<td>policy</td><td>held_out_accuracy</td><td>0.375</td>"),
              std::string::npos);
}

}  // namespace
}  // namespace selfplay::alphago
