// What GTP says with a network behind it, in the forms of KataGo and Leela Zero.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "engine/games.h"
#include "nn/load.h"
#include "tests/nn/shared.h"
#include "tests/protocols/gtp_guest.h"
#include "tests/search/fake_network.h"

namespace protocols {

namespace {

std::string line_of(const std::string& text, std::string_view start) {
    const auto at = text.find(std::string(start) + " ");
    return at == text.npos ? "" : text.substr(at, text.find('\n', at) - at);
}

// The vectors of KataGo's own program, in its own digits.
struct KataGo : testing::Test {
    void SetUp() override {
        const auto path = nn::shared_data() / "nets" / "g170-b6c96-s175395328-d26788732.bin.gz";
        if (!std::filesystem::exists(path)) GTEST_SKIP() << "the shared data is not there";
        ASSERT_EQ(guest.say("kata-set-param WeightsFile " + path.string()), "=");
        guest.say("kata-set-rules tromp-taylor");
        guest.say("komi 7");
    }
    GtpGuest guest;
};

TEST_F(KataGo, SaysTheEmptyBoardAsKataGoDoes) {
    const auto text = guest.ask("kata-raw-nn 0");
    EXPECT_EQ(line_of(text, "symmetry"), "symmetry 0");
    EXPECT_EQ(line_of(text, "whiteLead"), "whiteLead -0.635");
    EXPECT_EQ(line_of(text, "whiteScoreSelfplay"), "whiteScoreSelfplay -0.503");
    EXPECT_EQ(line_of(text, "noResult"), "noResult 0.000000");
    EXPECT_NEAR(std::stod(line_of(text, "whiteWin").substr(9)), 0.488470, 2e-6);
    EXPECT_NEAR(std::stod(line_of(text, "whiteScoreSelfplaySq").substr(20)), 214.928, 2e-3);
    EXPECT_NEAR(std::stod(line_of(text, "policyPass").substr(11)), 0.000331, 2e-6);
    EXPECT_TRUE(has(text, "0.26059")) << text;
    EXPECT_TRUE(has(text, "whiteOwnership\n")) << text;
}

TEST_F(KataGo, SaysWhitesTurnAsWhite) {
    for (const char* move : {"play b E5", "play w C3", "play b G3"}) guest.say(move);
    const auto text = guest.ask("kata-raw-nn 0");
    EXPECT_NEAR(std::stod(line_of(text, "whiteWin").substr(9)), 0.566107, 2e-6);
    EXPECT_EQ(line_of(text, "whiteLead"), "whiteLead 1.090");
    EXPECT_TRUE(has(text, "NAN"));
}

TEST_F(KataGo, AllIsEverySymmetry) {
    const auto text = guest.ask("kata-raw-nn all");
    for (int i = 0; i < 8; ++i) EXPECT_TRUE(has(text, fmt::format("symmetry {}\n", i))) << i;
}

TEST_F(KataGo, HeatmapIsInThousandths) {
    const auto text = guest.ask("heatmap");
    EXPECT_TRUE(has(text, "260 ")) << text;
    EXPECT_TRUE(has(text, "pass: 0\n")) << text;
    EXPECT_TRUE(has(text, "winrate: 0.5115")) << text;
    EXPECT_NE(guest.ask("heatmap average"), text);
}

TEST_F(KataGo, PlaysWithIt) {
    EXPECT_EQ(guest.say("lz-setoption name Visits value 50"), "=");
    EXPECT_EQ(guest.ask("genmove b"), "E5");
    const auto text = guest.ask("kata-search_analyze w 100 ownership true rootInfo true");
    EXPECT_TRUE(has(text, "scoreLead")) << text;
    EXPECT_TRUE(has(text, "ownership")) << text;
}

TEST(GtpNetwork, NoneIsSaidToBeMissing) {
    GtpGuest guest;
    EXPECT_EQ(guest.say("kata-raw-nn 0"), "? there is no network: start with --weights FILE");
    EXPECT_TRUE(has(guest.say("kata-set-param WeightsFile no-such-net"), "no-such-net; tried"));
    EXPECT_TRUE(has(guest.say("lz-setoption name WeightsFile value no-such-net"), "tried"));
}

// A network of our own, saved and loaded; of the wrong game or board refused by name.
class OwnNetwork : public testing::Test {
   protected:
    std::string saved(const nn::Graph& graph) const {
        nn::save(graph, path_);
        return path_.string();
    }
    void TearDown() override { std::filesystem::remove(path_); }
    std::filesystem::path path_ = std::filesystem::path(testing::TempDir()) /
                                  fmt::format("gtp-network-{}.safetensors", ::getpid());
};

TEST_F(OwnNetwork, IsRefusedByNameWhereItDoesNotFit) {
    GtpGuest guest;
    const auto wrong = saved(fake::small_network<chess::Chess>());
    EXPECT_EQ(guest.say("kata-set-param WeightsFile " + wrong),
              "? the network random plays chess, not go");
    auto graph = fake::small_network<go::Go>();
    graph.facts.board = 9;
    EXPECT_EQ(guest.say("kata-set-param WeightsFile " + saved(graph)), "=");
    EXPECT_EQ(guest.say("boardsize 13"), "? the network random is for boards of 9x9, not 13x13");
    EXPECT_EQ(guest.say("query_boardsize"), "= 9");
}

// Weights so large that activations overflow.
TEST_F(OwnNetwork, ThatYieldsNoNumbersStillPlaysALegalMove) {
    auto graph = fake::small_network<go::Go>();
    for (auto& node : graph.nodes)
        if (node.operation == nn::Operation::convolution)
            for (float& weight : node.weights[0].values) weight *= 1e30f;
    GtpGuest guest;
    ASSERT_EQ(guest.say("kata-set-param WeightsFile " + saved(graph)), "=");
    const auto answer = guest.say("genmove b");
    EXPECT_TRUE(answer.starts_with("= ")) << answer;
    EXPECT_TRUE(has(guest.say("kata-raw-nn 0"), "no number"));
}

}  // namespace

}  // namespace protocols
