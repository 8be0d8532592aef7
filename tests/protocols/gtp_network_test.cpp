// What GTP says with a network behind it, in the forms of KataGo and Leela Zero.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <sstream>
#include <tuple>

#include "engine/games.h"
#include "nn/backend.h"
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
        path = nn::shared_data() / "nets" / "g170-b6c96-s175395328-d26788732.bin.gz";
        if (!std::filesystem::exists(path)) GTEST_SKIP() << "the shared data is not there";
        ASSERT_EQ(guest.say("kata-set-param WeightsFile " + path.string()), "=");
        guest.say("kata-set-rules tromp-taylor");
        guest.say("komi 7");
    }
    std::filesystem::path path;
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

// The policy's prior of a vertex, read off the rows.
double prior_at(const std::string& text, int size, char column, int row) {
    std::istringstream in(text.substr(text.find("policy\n") + 7));
    std::string word;
    const int x = column - 'A' - (column > 'I' ? 1 : 0);
    for (int i = 0; i <= (size - row) * size + x; ++i) in >> word;
    return word == "NAN" ? -1 : std::stod(word);
}

double number_of(const std::string& text, std::string_view name) {
    return std::stod(line_of(text, name).substr(name.size()));
}

TEST_F(KataGo, SaysJapanesePositionsAsKataGoDoes) {
    guest.say("kata-set-rules japanese");
    guest.say("komi 6.5");
    for (const char* move : {"play b E5", "play w C3", "play b G3"}) guest.say(move);
    const auto text = guest.ask("kata-raw-nn 0");
    EXPECT_NEAR(number_of(text, "whiteWin"), 0.559578, 2e-6);
    EXPECT_NEAR(number_of(text, "whiteLoss"), 0.440372, 2e-6);
    EXPECT_NEAR(number_of(text, "noResult"), 0.000050, 2e-6);
    EXPECT_NEAR(number_of(text, "whiteLead"), 0.979, 2e-3);
    EXPECT_NEAR(prior_at(text, 9, 'D', 6), 0.347640, 1e-5);
    EXPECT_NEAR(prior_at(text, 9, 'C', 6), 0.257492, 1e-5);
    EXPECT_NEAR(prior_at(text, 9, 'F', 4), 0.209936, 1e-5);
    EXPECT_EQ(prior_at(text, 9, 'E', 5), -1);
}

TEST_F(KataGo, SaysTheLargeBoardAsKataGoDoes) {
    guest.say("boardsize 19");
    guest.say("kata-set-rules chinese");
    guest.say("komi 7.5");
    const auto text = guest.ask("kata-raw-nn 0");
    EXPECT_NEAR(number_of(text, "whiteWin"), 0.524470, 2e-6);
    EXPECT_NEAR(number_of(text, "whiteLoss"), 0.475457, 2e-6);
    EXPECT_NEAR(number_of(text, "noResult"), 0.000073, 2e-6);
    EXPECT_NEAR(number_of(text, "whiteLead"), -0.183, 2e-3);
    EXPECT_NEAR(number_of(text, "whiteScoreSelfplaySq"), 976.777, 2e-2);
    for (const auto& [column, row, prior] : {std::tuple{'C', 17, 0.031055},
                                             {'D', 17, 0.080097},
                                             {'Q', 17, 0.087696},
                                             {'R', 17, 0.016749},
                                             {'C', 16, 0.083175},
                                             {'D', 16, 0.045550},
                                             {'Q', 16, 0.038541},
                                             {'R', 16, 0.074604}})
        EXPECT_NEAR(prior_at(text, 19, column, row), prior, 1e-5) << column << row;
}

// What it says in so many digits does not depend on what the search runs, unless that was asked.
TEST_F(KataGo, ACoarsePrecisionShowsOnlyWhereItWasAskedFor) {
    if (const auto why = nn::why_not(nn::load(path), nn::Precision::int8, 9); !why.empty())
        GTEST_SKIP() << "no int8: " << why;
    const auto exact = guest.ask("kata-raw-nn 0");
    ASSERT_EQ(guest.say("kata-set-param Precision int8"), "=");
    EXPECT_EQ(guest.ask("kata-get-param Precision"), "int8");
    const auto coarse = guest.ask("kata-raw-nn 0");
    EXPECT_NE(coarse, exact);
    EXPECT_NEAR(number_of(coarse, "whiteWin"), number_of(exact, "whiteWin"), 0.05);
    ASSERT_EQ(guest.say("kata-set-param Precision fp32"), "=");
    EXPECT_EQ(guest.ask("kata-raw-nn 0"), exact);
    EXPECT_TRUE(has(guest.say("kata-set-param Precision half"),
                    "Precision must be one of auto, fp32, bf16, int8, int16, not half"));
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

// It takes a pass for the best move whatever the board looks like.
TEST_F(OwnNetwork, ThatLongsToPassPlaysOnWhileTheBoardIsOpen) {
    auto graph = fake::small_network<go::Go>();
    for (auto& node : graph.nodes)
        if (node.name == "policy.pass")
            for (float& bias : node.weights[1].values) bias = 20;
    GtpGuest guest;
    ASSERT_EQ(guest.say("kata-set-param WeightsFile " + saved(graph)), "=");
    guest.say("lz-setoption name Visits value 20");
    const auto text = guest.ask("kata-raw-nn 0");
    EXPECT_GT(std::stod(line_of(text, "policyPass").substr(11)), 0.99) << text;
    EXPECT_NE(guest.ask("genmove b"), "pass");
    for (const char* move : {"w C3", "b pass", "w G7"}) guest.say(std::string("play ") + move);
    EXPECT_NE(guest.ask("genmove b"), "pass");
}

// Weights so large that activations overflow.
TEST_F(OwnNetwork, ThatYieldsNoNumbersStillPlaysALegalMove) {
    auto graph = fake::small_network<go::Go>();
    for (auto& node : graph.nodes)
        if (node.operation == nn::Operation::convolution || node.operation == nn::Operation::dense)
            for (float& weight : node.weights[0].values) weight *= 1e30f;
    GtpGuest guest;
    // What is to be calibrated is refused.
    EXPECT_TRUE(has(guest.say("kata-set-param WeightsFile " + saved(graph)), "no number"));
    ASSERT_EQ(guest.say("kata-set-param Precision fp32"), "=");
    ASSERT_EQ(guest.say("kata-set-param WeightsFile " + saved(graph)), "=");
    const auto answer = guest.say("genmove b");
    EXPECT_TRUE(answer.starts_with("= ")) << answer;
}

}  // namespace

}  // namespace protocols
