// The learning network of a run: what becomes of it when files are torn or numbers run away.
#include "selfplay/training/student.h"

#include <gtest/gtest.h>

#include <limits>

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/go/go.h"
#include "nn/load.h"
#include "random_record.h"
#include "selfplay/training/network_settings.h"
#include "selfplay/training/replay.h"
#include "tests/temporary_folder.h"

namespace selfplay::training {
namespace {

struct StudentTest : testing::Test {
    tests::TemporaryFolder temporary;
    RunFolder folder{temporary.path() / "run"};
    Replay<go::Go> replay{{.held_out = 0}, "alphazero", 1};
    engine::Random random{1};
    LearnSettings settings{.batch = 16, .warm_up = 0};
    std::vector<std::string> said;

    StudentTest() {
        settings.numbers = Numbers::fp32;
        for (std::uint64_t i = 0; i < 4; ++i) replay.add(random_record(go::Go(5), i, 12), i);
    }
    Student make() {
        engine::Random weights(1);
        const auto shape = engine::find_encoding<go::Go>("alphazero").shape(go::Go(5));
        return {new_network({.blocks = 1, .channels = 8}, "go", shape, weights), settings, 1,
                folder, [this](const std::string& line) { said.push_back(line); }};
    }
    const nn::training::Samples& draw(const Student& student) {
        return replay.draw(settings.batch, student.terms(), random);
    }
};

TEST_F(StudentTest, GoesOnFromItsCheckpoint) {
    nn::Graph graph;
    {
        auto student = make();
        for (int i = 0; i < 3; ++i) student.learn(draw(student));
        student.save();
        graph = student.newest();
    }
    const auto student = make();
    EXPECT_EQ(student.steps(), 3);
    EXPECT_EQ(student.newest(), graph);
    EXPECT_TRUE(said.empty());
}

TEST_F(StudentTest, ATornCheckpointGivesWayToTheOneBefore) {
    {
        auto student = make();
        student.learn(draw(student));
        student.save();
        student.learn(draw(student));
        student.save();
    }
    auto bytes = engine::read_file(folder.checkpoint());
    bytes[bytes.size() - 5] ^= 1;
    engine::write_file(folder.checkpoint(), bytes);
    EXPECT_EQ(make().steps(), 1);
    ASSERT_EQ(said.size(), 1u);
    EXPECT_NE(said[0].find("going on from"), std::string::npos);
    engine::write_file(folder.old_checkpoint(), "torn");
    EXPECT_THROW(make(), engine::Error);
}

TEST_F(StudentTest, WhatIsNoNumberLeadsBackToTheCheckpointAndInTheEndToAHalt) {
    auto student = make();
    student.learn(draw(student));
    student.save();
    const auto sound = student.newest();
    student.learn(draw(student));
    auto samples = draw(student);
    std::vector<float> broken(samples.inputs[0].begin(), samples.inputs[0].end());
    broken[7] = std::numeric_limits<float>::quiet_NaN();
    samples.inputs[0] = broken;
    student.learn(samples);
    EXPECT_EQ(student.newest(), sound);
    EXPECT_EQ(student.steps(), 1);
    ASSERT_EQ(said.size(), 1u);
    student.learn(samples);
    student.learn(samples);
    EXPECT_THROW(student.learn(samples), engine::Error);
}

TEST_F(StudentTest, BatchNormsOfTheAverageAreMeasuredAnew) {
    settings.average = 0.9f;
    auto student = make();
    for (int i = 0; i < 5; ++i) student.learn(draw(student));
    const auto& samples = draw(student);
    const auto one = student.playable(samples), again = student.playable(samples);
    EXPECT_EQ(one, again);
    EXPECT_NO_THROW(nn::validate(one));
    EXPECT_NE(one, student.newest());
}

TEST_F(StudentTest, TwoRunsDoNotShareAFolder) {
    EXPECT_THROW(RunFolder(temporary.path() / "run"), engine::Error);
}

}  // namespace
}  // namespace selfplay::training
