// From a weight file to a network in play: calibration on games of its own, the precision that is
// chosen, and what is remembered of both.
#include "search/load_network.h"

#include <gtest/gtest.h>

#include "engine/base/files.h"
#include "engine/chess/chess.h"
#include "engine/games.h"
#include "engine/go/go.h"
#include "tests/search/fake_network.h"
#include "tests/temporary_folder.h"

namespace search {
namespace {

// Random weights, but with opinions: heads that count.
template <engine::Encoded G>
nn::Graph outspoken_network() {
    auto graph = fake::small_network<G>();
    for (const auto& output : graph.outputs) {
        auto* node = &graph.nodes[static_cast<std::size_t>(output.node)];
        while (node->weights.empty())
            node = &graph.nodes[static_cast<std::size_t>(node->inputs[0])];
        for (float& weight : node->weights[0].values)
            weight *= output.name == "wdl" ? 30.0f : 100.0f;
    }
    return graph;
}

class LoadNetwork : public testing::Test {
   protected:
    LoadNetwork() { setenv("XDG_CACHE_HOME", cache().c_str(), 1); }
    ~LoadNetwork() override { unsetenv("XDG_CACHE_HOME"); }

    std::filesystem::path cache() const { return folder_.path() / "cache"; }
    std::string saved(const nn::Graph& graph, const nn::Calibration& calibration = {}) const {
        const auto path = folder_.path() / "net.safetensors";
        nn::save(graph, path, calibration);
        return path.string();
    }
    // The only file of the cache folder.
    std::filesystem::path remembered() const {
        std::filesystem::path found;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(cache()))
            if (entry.is_regular_file()) found = entry.path();
        return found;
    }

   private:
    tests::TemporaryFolder folder_;
};

template <engine::Encoded G>
void check_precisions(const std::string& file, const G& game) {
    std::vector<G> positions;
    engine::Random random(7);
    const auto exact = load_network(file, nn::Precision::fp32, game);
    const auto reference = exact->make_evaluator();
    for (const auto& line : sample_lines(*reference, game, 4, 40, random))
        pick(line, 10, positions);
    const auto expected = answers_to<G>(*reference, positions);
    for (const auto precision : {nn::Precision::bf16, nn::Precision::int8, nn::Precision::int16}) {
        const auto evaluator = load_network(file, precision, game)->make_evaluator();
        const auto fidelity = fidelity_of(expected, answers_to<G>(*evaluator, positions));
        EXPECT_TRUE(tolerable(precision, fidelity))
            << G::name << " " << nn::name_of(precision) << ": " << fidelity.divergence << ", "
            << fidelity.value;
    }
}

TEST_F(LoadNetwork, EveryPrecisionKeepsToItsBounds) {
    check_precisions(saved(outspoken_network<go::Go>()), go::Go(9));
    check_precisions(saved(outspoken_network<chess::Chess>()), chess::Chess());
}

TEST_F(LoadNetwork, AutoIsOneThatKeepsToItsBoundsAndIsRemembered) {
    const auto file = saved(outspoken_network<go::Go>());
    const auto precision = load_network(file, {}, go::Go(9))->precision();
    const auto text = engine::read_file(remembered());
    EXPECT_NE(text.find(std::string("\"9\":\"") + std::string(nn::name_of(precision))),
              std::string::npos)
        << text.substr(0, 200);
    EXPECT_EQ(load_network(file, {}, go::Go(9))->precision(), precision);
}

TEST_F(LoadNetwork, WhatIsRememberedIsUsed) {
    const auto graph = outspoken_network<go::Go>();
    const auto file = saved(graph);
    load_network(file, {}, go::Go(9));
    const auto key = nn::load_contents(file).key;
    auto known = recall(key, graph);
    ASSERT_FALSE(known.calibration.maxima.empty());
    known.fastest[9] = nn::Precision::fp32;
    remember(key, graph, known);
    EXPECT_EQ(load_network(file, {}, go::Go(9))->precision(), nn::Precision::fp32);
    // Another board is timed on its own, and adds to what is known.
    load_network(file, {}, go::Go(13));
    EXPECT_EQ(recall(key, graph).fastest.size(), 2u);
    EXPECT_EQ(recall(key, graph).calibration, known.calibration);
}

TEST_F(LoadNetwork, ADamagedMemoryIsNone) {
    const auto graph = outspoken_network<go::Go>();
    const auto file = saved(graph);
    load_network(file, {}, go::Go(9));
    const auto path = remembered();
    const auto whole = engine::read_file(path);
    const auto key = nn::load_contents(file).key;
    const auto known = recall(key, graph);
    for (const std::string& text : {std::string(), std::string("{}"), std::string("[1, 2"),
                                    whole.substr(0, whole.size() / 2)}) {
        engine::write_file(path, text);
        EXPECT_TRUE(recall(key, graph).fastest.empty()) << text.substr(0, 20);
        EXPECT_TRUE(recall(key, graph).calibration.maxima.empty()) << text.substr(0, 20);
    }
    // Found out again: the calibration is the same, but another precision may have been the
    // fastest.
    load_network(file, {}, go::Go(9));
    EXPECT_EQ(recall(key, graph).calibration, known.calibration);
    EXPECT_TRUE(recall(key, graph).fastest.contains(9));
}

TEST_F(LoadNetwork, ACacheThatCannotBeWrittenDoesNoHarm) {
    engine::write_file(cache(), "no folder");
    const auto file = saved(outspoken_network<go::Go>());
    EXPECT_NE(load_network(file, {}, go::Go(9)), nullptr);
    EXPECT_EQ(engine::read_file(cache()), "no folder");
}

TEST_F(LoadNetwork, AFileThatKnowsItsScalesNeedsNoCalibration) {
    const auto graph = outspoken_network<go::Go>();
    const std::vector<go::Go> positions{go::Go(9)};
    const auto calibration = calibrate<go::Go>(graph, positions);
    const auto file = saved(graph, calibration);
    EXPECT_EQ(nn::load_contents(file).calibration, calibration);
    EXPECT_EQ(nn::load(file), graph);
    load_network(file, nn::Precision::int16, go::Go(9));
    EXPECT_FALSE(std::filesystem::exists(cache()));
}

TEST(Calibrate, OfSeveralBoardsIsTheLargestOfEach) {
    const auto graph = outspoken_network<go::Go>();
    const std::vector<go::Go> both{go::Go(9), go::Go(13)};
    const auto together = calibrate<go::Go>(graph, both);
    const auto small = calibrate<go::Go>(graph, std::span(both).first(1));
    const auto large = calibrate<go::Go>(graph, std::span(both).last(1));
    const std::vector<go::Go> turned{go::Go(13), go::Go(9)};
    EXPECT_EQ(calibrate<go::Go>(graph, turned), together);
    ASSERT_EQ(together.maxima.size(), small.maxima.size());
    for (std::size_t n = 0; n < together.maxima.size(); ++n) {
        // Vectors may be longer where the board is larger.
        ASSERT_EQ(together.maxima[n].size(), large.maxima[n].size());
        for (std::size_t c = 0; c < small.maxima[n].size(); ++c)
            EXPECT_EQ(together.maxima[n][c], std::max(small.maxima[n][c], large.maxima[n][c]));
    }
}

TEST(SampleLines, AreGamesAndTheSameForOneSeed) {
    const NetworkSource<go::Go> source(
        std::make_shared<Network>(outspoken_network<go::Go>(), nn::Precision::fp32));
    const auto evaluator = source.make_evaluator();
    engine::Random random(3), again(3);
    const auto lines = sample_lines(*evaluator, go::Go(5), 3, 200, random);
    EXPECT_EQ(lines, sample_lines(*evaluator, go::Go(5), 3, 200, again));
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_NE(lines[0], lines[1]);
    int games = 0;
    for (const auto& line : lines) {
        EXPECT_EQ(line.size(), 201u);
        for (std::size_t i = 0; i + 1 < line.size(); ++i) {
            EXPECT_EQ(line[i].outcome(), engine::Outcome::ongoing);
            const int before = line[i].move_count(), after = line[i + 1].move_count();
            EXPECT_TRUE(after == before + 1 || after == 0);
            games += after == 0 ? 1 : 0;
        }
    }
    EXPECT_GT(games, 0);
}

TEST(Fidelity, OfAnswersKnownByHand) {
    Evaluation expected, found;
    expected.priors = {0.5f, 0.5f};
    found.priors = {0.25f, 0.75f};
    expected.win = 0.5f;
    expected.draw = 0.5f;
    found.win = 0.6f;
    const auto fidelity = fidelity_of({&expected, 1}, {&found, 1});
    EXPECT_NEAR(fidelity.divergence, 0.5 * std::log(2.0) + 0.5 * std::log(2.0 / 3), 1e-6);
    EXPECT_NEAR(fidelity.value, 0.15, 1e-6);
    EXPECT_FALSE(tolerable(nn::Precision::int8, fidelity));
    EXPECT_TRUE(tolerable(nn::Precision::int8, {0.009, 0.019}));
    EXPECT_FALSE(tolerable(nn::Precision::int16, {0.009, 0.001}));
    EXPECT_TRUE(tolerable(nn::Precision::fp32, fidelity));
}

}  // namespace
}  // namespace search
