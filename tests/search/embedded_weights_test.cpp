// What the executable carries is what lay in the folder of weights when it was built.
#include "search/embedded_weights.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/games.h"
#include "search/load_player.h"

namespace search {
namespace {

template <class G>
class Embedded : public testing::Test {};
using AllGames = testing::Types<go::Go, chess::Chess, shogi::Shogi>;
TYPED_TEST_SUITE(Embedded, AllGames);

TYPED_TEST(Embedded, IsTheFileOfItsGame) {
    const auto file =
        std::filesystem::path(SANBAN_WEIGHTS) / (std::string(TypeParam::name) + ".safetensors");
    const auto embedded = embedded_weights(TypeParam::name);
    if (embedded.empty()) GTEST_SKIP() << "built without a network for " << TypeParam::name;
    EXPECT_TRUE(embedded == engine::read_file(file));
}

TYPED_TEST(Embedded, IsLoadedByItsName) {
    const auto bytes = embedded_weights(TypeParam::name);
    if (bytes.empty()) {
        EXPECT_THROW(load_player(std::string(embedded_name), nn::Precision::fp32, TypeParam()),
                     engine::Error);
    } else {
        const auto contents = nn::contents_from_bytes(bytes);
        EXPECT_EQ(contents.graph.facts.game, TypeParam::name);
    }
}

TEST(EmbeddedWeights, ThereIsNoneForAnotherGame) {
    EXPECT_TRUE(embedded_weights("draughts").empty());
}

TEST(EmbeddedWeights, TheChoiceGoesByBoardAndMethod) {
    const auto choice = [](int size, Method method) {
        return embedded_choice(go::Go(size), method);
    };
    EXPECT_EQ(choice(5, Method::automatic), "");
    EXPECT_EQ(choice(5, Method::puct), "go");
    EXPECT_EQ(choice(9, Method::automatic), "go");
    const auto large = embedded_weights("go-13x13").empty() ? "go" : "go-13x13";
    const auto largest = embedded_weights("go-19x19").empty() ? large : "go-19x19";
    EXPECT_EQ(choice(10, Method::automatic), large);
    EXPECT_EQ(choice(15, Method::automatic), large);
    EXPECT_EQ(choice(16, Method::automatic), largest);
    EXPECT_EQ(choice(19, Method::automatic), largest);
    EXPECT_EQ(choice(19, Method::puct), largest);
    EXPECT_EQ(embedded_choice(chess::Chess(), Method::automatic), "chess");
    if (embedded_weights("alphago-19x19/policy").empty())
        GTEST_SKIP() << "built without AlphaGo's networks";
    EXPECT_EQ(choice(19, Method::alphago), embedded_alphago);
    EXPECT_EQ(choice(18, Method::alphago), largest);
}

TEST(EmbeddedWeights, LargeBoardsHaveNetworksOfTheirOwn) {
    for (const auto& [size, name] : embedded_large_go) {
        const auto embedded = embedded_weights(name);
        if (embedded.empty()) GTEST_SKIP() << "built without " << name;
        const auto file =
            std::filesystem::path(SANBAN_WEIGHTS) / fmt::format("{}.safetensors", name);
        EXPECT_TRUE(embedded == engine::read_file(file));
        EXPECT_NE(load_player(std::string(embedded_name), nn::Precision::fp32, go::Go(size)),
                  nullptr)
            << size;
    }
}

TEST(EmbeddedWeights, AlphaGosNetworksPlayLargeBoards) {
    if (embedded_weights("alphago-19x19/policy").empty())
        GTEST_SKIP() << "built without AlphaGo's networks";
    const go::Go game(19);
    const auto source =
        load_player(std::string(embedded_name), nn::Precision::fp32, game, Method::alphago);
    ASSERT_NE(source, nullptr);
    EXPECT_TRUE(source->blends());
    EXPECT_NE(load_player(std::string(embedded_name), nn::Precision::fp32, go::Go(9)), nullptr);
    EXPECT_EQ(load_player(std::string(embedded_name), nn::Precision::fp32, go::Go(5)), nullptr);
}

}  // namespace
}  // namespace search
