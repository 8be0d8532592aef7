// The scattered first positions of chess: legal, under way, of all sorts, and where they are used.
#include "selfplay/training/scatter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "selfplay/training/terms.h"

namespace selfplay::training {
namespace {

struct Men {
    int white = 0, black = 0;
};

Men count(const chess::Chess& game) {
    Men men;
    const auto text = game.to_text();
    for (const char letter : text.substr(0, text.find(' '))) {
        men.white += letter >= 'A' && letter <= 'Z';
        men.black += letter >= 'a' && letter <= 'z';
    }
    return men;
}

TEST(Scatter, PositionsAreUnderWayAndOfAllSorts) {
    engine::Random random(1);
    int fewest = 32, most = 0, white_to_move = 0, uneven = 0;
    constexpr int positions = 400;
    for (int i = 0; i < positions; ++i) {
        const auto game = scattered_chess(random);
        ASSERT_EQ(game.outcome(), engine::Outcome::ongoing) << game.to_text();
        ASSERT_NE(game.to_text().find(" - - 0 1"), std::string::npos) << game.to_text();
        const auto men = count(game);
        ASSERT_LE(men.white, 16);
        ASSERT_LE(men.black, 16);
        fewest = std::min(fewest, men.white + men.black);
        most = std::max(most, men.white + men.black);
        uneven += men.white != men.black;
        white_to_move += game.to_play() == engine::Player::first;
    }
    EXPECT_EQ(fewest, 3);  // two kings alone are a draw
    EXPECT_GT(most, 28);
    EXPECT_GT(uneven, positions / 2);
    EXPECT_GT(white_to_move, positions / 3);
    EXPECT_LT(white_to_move, 2 * positions / 3);
}

TEST(Scatter, SameSeedSamePosition) {
    engine::Random one(7), other(7), third(8);
    const auto text = scattered_chess(one).to_text();
    EXPECT_EQ(text, scattered_chess(other).to_text());
    EXPECT_NE(text, scattered_chess(third).to_text());
}

TEST(Scatter, GamesBeginSoAsOftenAsTheSettingSays) {
    engine::Random random(1);
    const auto usual = chess::Chess().to_text();
    for (const float share : {0.0f, 0.5f, 1.0f}) {
        ActorSettings settings;
        settings.scattered_share = share;
        int scattered = 0;
        constexpr int games = 200;
        for (int i = 0; i < games; ++i)
            scattered += first_position<chess::Chess>(settings, random).to_text() != usual;
        EXPECT_NEAR(scattered, share * games, share == 0.5f ? 35 : 0);
        EXPECT_EQ(largest_position<chess::Chess>(settings).to_text(), usual);
    }
}

}  // namespace
}  // namespace selfplay::training
