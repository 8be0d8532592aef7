// `sanban train` as a whole, by the executable: it learns, it goes on where it was stopped, and
// nothing that stops it costs more than the games in flight.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "engine/base/files.h"
#include "engine/base/random.h"
#include "nn/load.h"
#include "selfplay/records/segment.h"
#include "selfplay/training/folder.h"
#include "selfplay/training/journal.h"
#include "tests/temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using selfplay::training::RunFolder;

struct TrainTest : testing::Test {
    tests::TemporaryFolder temporary;
    fs::path folder = temporary.path() / "run";
    fs::path log = temporary.path() / "log";

    // A loop so small that it publishes a network several times a second.
    std::vector<std::string> small() const {
        return {"--game",
                "go",
                "--size",
                "5",
                "--dir",
                folder.string(),
                "--blocks",
                "1",
                "--channels",
                "4",
                "--value-width",
                "4",
                "--threads",
                "1",
                "--games-at-once",
                "8",
                "--simulations",
                "4",
                "--fast-simulations",
                "2",
                "--candidates",
                "4",
                "--learn-batch",
                "16",
                "--micro-batch",
                "16",
                "--refresh",
                "4",
                "--first-games",
                "2",
                "--ladder-share",
                "0",
                "--learn-precision",
                "fp32"};
    }
    pid_t start(std::vector<std::string> words) const {
        words.insert(words.begin(), {SANBAN_EXECUTABLE, "train"});
        std::vector<char*> pointers;
        for (auto& word : words) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        const pid_t child = ::fork();
        if (child == 0) {
            if (!std::freopen(log.c_str(), "a", stderr)) ::_exit(9);
            ::execv(pointers[0], pointers.data());
            ::_exit(9);
        }
        return child;
    }
    static int wait_for(pid_t child) {
        int status = 0;
        ::waitpid(child, &status, 0);
        return status;
    }
    int run(std::vector<std::string> words) const { return wait_for(start(std::move(words))); }
    std::vector<std::string> with(std::vector<std::string> more) const {
        auto words = small();
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    std::size_t games() const {
        std::size_t count = 0;
        if (!fs::exists(folder / "games")) return 0;
        for (const auto& entry : fs::directory_iterator(folder / "games"))
            count += selfplay::records::unpack(engine::read_file(entry.path())).games.size();
        return count;
    }
    std::string told() const { return fs::exists(log) ? engine::read_file(log) : ""; }
};

TEST_F(TrainTest, LearnsAndGoesOn) {
    ASSERT_EQ(run(with({"--games", "40"})), 0) << told();
    const auto first = games();
    EXPECT_GE(first, 40u);
    const auto steps = nn::load(folder / "latest.safetensors").facts.steps;
    EXPECT_GT(steps, 0);
    // A fast machine plays more than it was asked for before it looks.
    const auto more = first + 40;
    ASSERT_EQ(run(with({"--games", std::to_string(more)})), 0) << told();
    EXPECT_GE(games(), more);
    EXPECT_GT(nn::load(folder / "latest.safetensors").facts.steps, steps);
    const selfplay::training::Journal journal(folder / "metrics.jsonl");
    ASSERT_FALSE(journal.entries().empty());
    EXPECT_GE(journal.entries().back().games, more);
    EXPECT_GT(journal.entries().back().learned.policy_loss, 0);
    EXPECT_EQ(journal.entries().back().simulations, 4);
    EXPECT_GE(journal.entries().back().resign_threshold, -1);
}

// On another machine only the weights are left of a run.
TEST_F(TrainTest, ANewRunLearnsOnFromAFile) {
    ASSERT_EQ(run(with({"--games", "40"})), 0) << told();
    const auto file = folder.parent_path() / "carried.safetensors";
    fs::rename(folder / "latest.safetensors", file);
    const auto steps = nn::load(file).facts.steps;
    fs::remove_all(folder);
    EXPECT_NE(run(with({"--games", "4", "--from", file.string(), "--moves-left", "true"})), 0);
    EXPECT_NE(told().find("built otherwise"), std::string::npos);
    fs::remove_all(folder);
    ASSERT_EQ(run(with({"--games", "40", "--from", file.string()})), 0) << told();
    EXPECT_GT(nn::load(folder / "latest.safetensors").facts.steps, steps);
    // As a larger network, too; not as a smaller one.
    const auto carried = nn::load(file).facts;
    const auto as = [&](int channels) {
        fs::remove_all(folder);
        auto words = with({"--games", "4", "--from", file.string()});
        *(std::ranges::find(words, "--channels") + 1) = std::to_string(channels);
        return run(words);
    };
    EXPECT_NE(as(carried.channels - 1), 0);
    ASSERT_EQ(as(carried.channels + 4), 0) << told();
    const auto larger = nn::load(folder / "latest.safetensors").facts;
    EXPECT_EQ(larger.channels, carried.channels + 4);
    EXPECT_GE(larger.steps, carried.steps);
}

TEST_F(TrainTest, AStopEndsItCleanly) {
    for (const int signal : {SIGINT, SIGTERM}) {
        fs::remove_all(folder);
        const auto child = start(small());
        for (int i = 0; i < 600 && !fs::exists(folder / "latest.safetensors"); ++i)
            std::this_thread::sleep_for(50ms);
        std::this_thread::sleep_for(300ms);
        ::kill(child, signal);
        EXPECT_EQ(wait_for(child), 0) << told();
    }
}

TEST_F(TrainTest, BadSettingsAreRefusedAtOnce) {
    EXPECT_NE(run({"--dir", folder.string(), "--size", "30"}), 0);
    EXPECT_NE(run({"--dir", folder.string(), "--sise", "9"}), 0);
    EXPECT_NE(run({"--dir", folder.string(), "--preset", "alphastar"}), 0);
    EXPECT_FALSE(fs::exists(folder));
    ASSERT_EQ(run(with({"--games", "4"})), 0) << told();
    EXPECT_NE(run({"--dir", folder.string(), "--game", "chess"}), 0);
    EXPECT_NE(told().find("name another folder"), std::string::npos);
}

// Starts a run, kills it after a while, and looks at what is left. Yields how many games are.
std::size_t games_after_a_kill(const TrainTest& test, engine::Random& random) {
    const auto child = test.start(test.small());
    std::this_thread::sleep_for(std::chrono::milliseconds(20 + random.below(500)));
    ::kill(child, SIGKILL);
    EXPECT_TRUE(WIFSIGNALED(TrainTest::wait_for(child))) << "it ended by itself: " << test.told();
    if (fs::exists(test.folder / "latest.safetensors")) {
        EXPECT_NO_THROW(nn::load(test.folder / "latest.safetensors"));
    }
    return test.games();
}

TEST_F(TrainTest, FiftyKillsAtAnyMomentLoseNothingThatWasFinished) {
    engine::Random random(7);
    std::size_t before = 0;
    for (int kill = 0; kill < 50; ++kill) {
        const auto now = games_after_a_kill(*this, random);
        EXPECT_GE(now, before) << "after kill " << kill;
        before = now;
    }
    EXPECT_GT(before, 0u);
    ASSERT_EQ(run(with({"--games", std::to_string(before + 20)})), 0) << told();
    EXPECT_GE(games(), before + 20);
    EXPECT_GT(nn::load(folder / "latest.safetensors").facts.steps, 0);
    EXPECT_GE(RunFolder(folder).state().games, before + 20);
}

}  // namespace
