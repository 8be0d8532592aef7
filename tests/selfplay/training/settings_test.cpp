// The settings of a run: recipes, their file, and what is refused before anything begins.
#include "selfplay/training/settings.h"

#include <gtest/gtest.h>

#include <set>

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/go/go.h"
#include "tests/temporary_folder.h"

namespace selfplay::training {
namespace {

std::string refusal(const std::function<void()>& act) {
    try {
        act();
    } catch (const engine::Error& error) {
        return error.what();
    }
    return "";
}

TEST(TrainSettings, EveryNameIsThereOnce) {
    std::set<std::string_view> names;
    for (const auto& row : setting_rows(Settings()))
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_GT(names.size(), 50u);
}

TEST(TrainSettings, EveryPresetFitsEveryGame) {
    for (const auto preset : preset_names)
        for (const std::string_view game : {"go", "chess", "shogi"})
            for (const int size : {5, 9, 19}) {
                const auto settings = preset_settings(preset, game, size);
                EXPECT_EQ(refusal([&] { check(settings); }), "") << preset << game << size;
            }
}

TEST(TrainSettings, TheFileHoldsThemAll) {
    auto settings = preset_settings("alphagozero", "go", 13);
    set_setting(settings, "rate", "0.125");
    set_setting(settings, "gate", "false");
    set_setting(settings, "optimiser", "adamw");
    const auto back = settings_from_json(to_json(settings));
    const auto was = setting_rows(settings), is = setting_rows(back);
    ASSERT_EQ(was.size(), is.size());
    for (std::size_t i = 0; i < was.size(); ++i) EXPECT_EQ(was[i].value, is[i].value);
    EXPECT_EQ(back.preset, "alphagozero");
}

TEST(TrainSettings, WhatIsWrongIsRefusedWithAWordOnIt) {
    Settings settings;
    EXPECT_NE(refusal([&] { set_setting(settings, "ratee", "1"); }).find("no setting ratee"),
              std::string::npos);
    EXPECT_NE(refusal([&] { set_setting(settings, "size", "26"); }).find("2..25"),
              std::string::npos);
    EXPECT_NE(refusal([&] { set_setting(settings, "rate", "nan"); }), "");
    EXPECT_NE(refusal([&] { preset_settings("alphastar", "go", 9); }).find("laptop"),
              std::string::npos);
    EXPECT_NE(refusal([&] { settings_from_json("{\"ratee\": 1}"); }).find("ratee"),
              std::string::npos);
    EXPECT_NE(refusal([&] { settings_from_json("[1"); }), "");
    EXPECT_NE(refusal([&] { settings_from_json("{\"rate\": [1]}"); }), "");
    settings.learn.first_drop = 100;
    settings.learn.second_drop = 50;
    EXPECT_NE(refusal([&] { check(settings); }).find("rise"), std::string::npos);
}

TEST(TrainSettings, AFolderStaysWithItsGameAndNetwork) {
    const tests::TemporaryFolder folder;
    Wanted wanted;
    wanted.size = 5;
    wanted.changes = {{"blocks", "2"}, {"rate", "0.5"}};
    keep_settings(folder.path(), settings_for(folder.path(), wanted));
    const auto resumed = settings_for(folder.path(), {});
    EXPECT_EQ(resumed.network.blocks, 2);
    EXPECT_EQ(resumed.actors.size, 5);
    EXPECT_EQ(resumed.learn.rate, 0.5f);
    Wanted other;
    other.game = "chess";
    EXPECT_NE(refusal([&] { settings_for(folder.path(), other); }).find("run of go"),
              std::string::npos);
    Wanted larger;
    larger.changes = {{"blocks", "3"}};
    EXPECT_NE(refusal([&] { settings_for(folder.path(), larger); }).find("blocks 2"),
              std::string::npos);
    Wanted slower;
    slower.changes = {{"rate", "0.25"}};
    EXPECT_EQ(settings_for(folder.path(), slower).learn.rate, 0.25f);
}

TEST(TrainSettings, ATaughtNetworkNeedsNoRollouts) {
    Wanted wanted;
    wanted.game = "shogi";
    EXPECT_GT(settings_for({}, wanted).run.rollout_games, 0);
    wanted.taught = true;
    EXPECT_EQ(settings_for({}, wanted).run.rollout_games, 0);
    wanted.changes = {{"rollout-games", "50"}};
    EXPECT_EQ(settings_for({}, wanted).run.rollout_games, 50);
}

TEST(TrainSettings, LearningComputesInTheFasterNumbersUnlessToldOtherwise) {
    const auto graph = new_network(NetworkSettings{.blocks = 1, .channels = 16}, go::Go(5), 1);
    const auto precision = [&](std::string_view name) {
        Settings settings;
        if (!name.empty()) set_setting(settings, "learn-precision", name);
        return learner_settings(settings.learn, graph, 1).precision;
    };
    EXPECT_EQ(precision("fp32"), nn::Precision::fp32);
    EXPECT_EQ(precision("bf16"), nn::Precision::bf16);
    EXPECT_EQ(precision("auto"), nn::training::faster_precision());
    EXPECT_EQ(precision(""), precision("auto"));
}

}  // namespace
}  // namespace selfplay::training
