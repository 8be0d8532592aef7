// What the executable carries is what lay in the folder of weights when it was built.
#include "search/embedded_weights.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/games.h"
#include "search/load_network.h"

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
    const std::string name(embedded_name);
    if (bytes.empty()) {
        EXPECT_THROW(load_network(name, nn::Precision::fp32, TypeParam()), engine::Error);
    } else {
        const auto contents = nn::contents_from_bytes(bytes);
        EXPECT_EQ(contents.graph.facts.game, TypeParam::name);
    }
}

TEST(EmbeddedWeights, ThereIsNoneForAnotherGame) {
    EXPECT_TRUE(embedded_weights("draughts").empty());
}

}  // namespace
}  // namespace search
