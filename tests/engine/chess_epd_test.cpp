#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "engine/base/error.h"
#include "engine/chess/epd.h"
#include "engine/chess/san.h"

namespace chess {
namespace {

TEST(ChessEpd, ReadsBestMovesAndNames) {
    const auto problem = problem_from_epd(
        "2rr3k/pp3pp1/1nnqbN1p/3pN3/2pP4/2P3Q1/PPB4P/R4RK1 w - - bm Qg6 Nfg4; am h4; "
        "id \"WAC; 001\"; dm 3; c9 \"x; y\";");
    EXPECT_EQ(problem.id, "WAC; 001");
    EXPECT_EQ(problem.mate_in, 3);
    ASSERT_EQ(problem.best.size(), 2u);
    EXPECT_EQ(san(problem.game.position(), problem.best[0]), "Qg6");
    EXPECT_EQ(san(problem.game.position(), problem.best[1]), "Nfg4");
    ASSERT_EQ(problem.avoid.size(), 1u);
    EXPECT_EQ(problem.others, std::vector<std::string>{"c9 \"x; y\""});
}

TEST(ChessEpd, ReadsPoints) {
    const auto problem = problem_from_epd(
        "1kr5/3n4/q3p2p/p2n2p1/PppB1P2/5BP1/1P2Q2P/3R2K1 w - - bm f5; "
        "c0 \"f5=10, Be5+=2, Bf2=3, Bg4=2\";");
    ASSERT_EQ(problem.points.size(), 4u);
    EXPECT_EQ(problem.points[0].move, problem.best[0]);
    EXPECT_EQ(problem.points[0].points, 10);
    EXPECT_EQ(san(problem.game.position(), problem.points[1].move), "Be5+");
    EXPECT_TRUE(problem_from_epd("4k3/8/8/8/8/8/8/4K3 w - - c0 \"White = better\"").points.empty());
}

TEST(ChessEpd, CountersMayBeThere) {
    const auto problem = problem_from_epd("4k3/8/8/8/8/8/8/4K2R w K - 7 31 bm O-O");
    EXPECT_EQ(problem.game.to_text(), "4k3/8/8/8/8/8/8/4K2R w K - 7 31");
    EXPECT_EQ(problem.best.size(), 1u);
}

TEST(ChessEpd, RefusesBadMovesAndPositions) {
    EXPECT_THROW(problem_from_epd("4k3/8/8/8/8/8/8/4K3 w - - bm Qa1;"), engine::Error);
    EXPECT_THROW(problem_from_epd("4k3/8/8/8/8/8/8/4K3 w - - dm soon;"), engine::Error);
    EXPECT_THROW(problem_from_epd("4k3/8/8/8/8 w - - bm Ke2;"), engine::Error);
    EXPECT_THROW(problem_from_epd(""), engine::Error);
}

TEST(ChessEpd, SharedSuites) {
    const char* shared = std::getenv("SANBAN_SHARED");
    const std::filesystem::path folder = shared ? shared : SANBAN_SOURCE_DIR "/../shared";
    std::ifstream tactics(folder / "data/chess/epd/wacnew.epd");
    std::ifstream strategy(folder / "data/chess/epd/sts/STS1-STS15_LAN_v3.epd");
    if (!tactics || !strategy) GTEST_SKIP() << "no test suites in " << folder;
    int solved = 0, scored = 0;
    for (std::string line; std::getline(tactics, line);)
        solved += !problem_from_epd(line).best.empty() || !problem_from_epd(line).avoid.empty();
    for (std::string line; std::getline(strategy, line);)
        scored += !problem_from_epd(line).points.empty();
    EXPECT_EQ(solved, 300);
    EXPECT_EQ(scored, 1500);
}

}  // namespace
}  // namespace chess
