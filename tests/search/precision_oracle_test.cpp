// What number formats cost in play: answers of whole networks on real positions, calibrated as a
// start of the program does it, against what the networks say in fp32.
#include <gtest/gtest.h>

#include "engine/games.h"
#include "nn/backend.h"
#include "search/load_network.h"
#include "tests/search/oracle.h"
#include "tests/temporary_folder.h"

namespace search {
namespace {

template <class G>
struct Positions {
    std::vector<G> all;
    // Every third on the way, and the last.
    void add(const std::vector<G>& line) {
        for (std::size_t back = 0; back < line.size(); back += 3)
            all.push_back(line[line.size() - 1 - back]);
    }
};

template <class G>
void check(const char* name, const std::vector<G>& positions) {
    ASSERT_GT(positions.size(), 10u);
    const auto answers = [&](nn::Precision precision) {
        const auto evaluator =
            load_network(oracle::network(name).string(), precision, positions[0])->make_evaluator();
        return answers_to<G>(*evaluator, positions);
    };
    const auto expected = answers(nn::Precision::fp32);
    const auto graph = nn::load(oracle::network(name));
    const int board = engine::find_encoding<G>(graph.facts.encoding).shape(positions[0]).height;
    for (const auto precision : {nn::Precision::bf16, nn::Precision::int8, nn::Precision::int16}) {
        if (nn::served_precision(graph, precision, board) != precision) continue;
        const auto fidelity = fidelity_of(expected, answers(precision));
        std::cout << name << " " << nn::name_of(precision) << ": " << positions.size()
                  << " positions, policy divergence " << fidelity.divergence << ", winrate error "
                  << fidelity.value << '\n';
        EXPECT_TRUE(tolerable(precision, fidelity)) << nn::name_of(precision);
    }
}

class PrecisionOracle : public testing::Test {
   protected:
    void SetUp() override {
        if (!std::filesystem::exists(nn::shared_data() / "nets"))
            GTEST_SKIP() << "the shared data is not there";
        setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1);
    }
    void TearDown() override { unsetenv("XDG_CACHE_HOME"); }

    static void check_go(const char* network, const char* answers, int size) {
        Positions<go::Go> positions;
        for (const auto& line : oracle::lines_of(answers))
            if (line["size"] == size) positions.add(oracle::go_positions(line));
        check(network, positions.all);
    }

   private:
    tests::TemporaryFolder folder_;
};

constexpr auto g170 = "g170-b6c96-s175395328-d26788732.bin.gz";

TEST_F(PrecisionOracle, G170On9x9) { check_go(g170, "katago-g170-b6c96.jsonl", 9); }
TEST_F(PrecisionOracle, G170On13x13) { check_go(g170, "katago-g170-b6c96.jsonl", 13); }
TEST_F(PrecisionOracle, G170On19x19) { check_go(g170, "katago-g170-b6c96.jsonl", 19); }
TEST_F(PrecisionOracle, Version9) {
    check_go("katago-b2c16-v9.bin.gz", "katago-b2c16-v9.jsonl", 9);
}
TEST_F(PrecisionOracle, NestedBottleneck) {
    check_go("katago-b1c6nbt-v11.bin.gz", "katago-b1c6nbt-v11.jsonl", 9);
}
TEST_F(PrecisionOracle, Maia) {
    Positions<chess::Chess> positions;
    for (const auto& line : oracle::lines_of("lc0-maia-1900.jsonl"))
        positions.add(oracle::chess_positions(line));
    check("maia-1900.pb.gz", positions.all);
}

}  // namespace
}  // namespace search
