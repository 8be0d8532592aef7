// The promises every game makes, checked on random games of each game in the list.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "engine/base/random.h"
#include "engine/encoding.h"
#include "engine/games.h"
#include "engine/rollout.h"

using namespace engine;

namespace {

template <class List>
struct ToTypes;
template <class... Gs>
struct ToTypes<GameList<Gs...>> {
    using type = testing::Types<Gs...>;
};

}  // namespace

template <class G>
struct GameContract : testing::Test {
    // Calls check(game) on positions of a few random games, all of their first moves and some of
    // the later ones.
    template <class Check>
    static void for_each_position(Check check) {
        Random random(1);
        for (int round = 0; round < 4; ++round) {
            G game;
            for (int ply = 0; ply < 400 && game.outcome() == Outcome::ongoing; ++ply) {
                if (ply < 8 || ply % 16 == round) check(game);
                const auto moves = game.legal_moves();
                game.play(moves[random.below(moves.size())]);
            }
            check(game);
        }
    }
};
TYPED_TEST_SUITE(GameContract, ToTypes<Games>::type);

TYPED_TEST(GameContract, StartsWithTheFirstPlayerAndAnOpenEnd) {
    const TypeParam game;
    EXPECT_EQ(game.to_play(), Player::first);
    EXPECT_EQ(game.outcome(), Outcome::ongoing);
    EXPECT_EQ(game, TypeParam());
}

TYPED_TEST(GameContract, LegalMovesAreDistinctAndRunOutOnlyAtTheEnd) {
    this->for_each_position([](const TypeParam& game) {
        const auto moves = game.legal_moves();
        std::set<std::uint16_t> codes;
        for (const Move move : moves) codes.insert(move.code);
        EXPECT_EQ(static_cast<int>(codes.size()), moves.size());
        if (game.outcome() == Outcome::ongoing) {
            EXPECT_FALSE(moves.empty());
        }
    });
}

TYPED_TEST(GameContract, MovesSurviveTheirOwnText) {
    this->for_each_position([](const TypeParam& game) {
        for (const Move move : game.legal_moves())
            EXPECT_EQ(game.move_from_text(game.move_to_text(move)), move)
                << game.move_to_text(move);
    });
}

TYPED_TEST(GameContract, PositionsSurviveTheirOwnText) {
    this->for_each_position([](const TypeParam& game) {
        const auto text = game.to_text();
        const auto again = TypeParam::from_text(text);
        EXPECT_EQ(again.to_text(), text);
        EXPECT_EQ(again.key(), game.key()) << text;
        EXPECT_EQ(again.to_play(), game.to_play());
        EXPECT_EQ(again.legal_moves().size(), game.legal_moves().size()) << text;
    });
}

TYPED_TEST(GameContract, CopiesAreEqualAndGoTheirOwnWay) {
    this->for_each_position([](const TypeParam& game) {
        TypeParam copy = game;
        EXPECT_EQ(copy, game);
        EXPECT_EQ(copy.key(), game.key());
        if (game.outcome() != Outcome::ongoing) return;
        const auto text = game.to_text();
        copy.play(copy.legal_moves()[0]);
        EXPECT_NE(copy.key(), game.key());
        EXPECT_EQ(game.to_text(), text);
    });
}

TYPED_TEST(GameContract, MovesLeadToDifferentKeys) {
    this->for_each_position([](const TypeParam& game) {
        if (game.outcome() != Outcome::ongoing) return;
        std::set<std::uint64_t> keys;
        const auto moves = game.legal_moves();
        for (const Move move : moves) {
            auto next = game;
            next.play(move);
            keys.insert(next.key());
        }
        EXPECT_EQ(static_cast<int>(keys.size()), moves.size()) << game.to_text();
    });
}

TYPED_TEST(GameContract, NoTextIsWorseThanAnError) {
    Random random(2);
    const auto good = TypeParam().to_text();
    for (int round = 0; round < 2000; ++round) {
        auto text = good.substr(
            0, static_cast<std::size_t>(random.below(static_cast<int>(good.size()) + 1)));
        for (int changes = random.below(4); changes > 0 && !text.empty(); --changes)
            text[static_cast<std::size_t>(random.below(static_cast<int>(text.size())))] =
                static_cast<char>(random.below(256));
        try {
            const auto game = TypeParam::from_text(text);
            EXPECT_EQ(TypeParam::from_text(game.to_text()).key(), game.key()) << text;
        } catch (const Error&) {
        }
        EXPECT_NO_THROW(TypeParam().move_from_text(text));
    }
    for (const std::string_view text : {"", " ", "resign", "a", "999", "\xff\xfe"})
        EXPECT_FALSE(TypeParam().move_from_text(text));
    EXPECT_THROW(TypeParam::from_text("nonsense"), Error);
}

TYPED_TEST(GameContract, RolloutsEndWithAResult) {
    typename RolloutsOf<TypeParam>::type rollouts;
    Random random(3);
    this->for_each_position([&](const TypeParam& game) {
        const auto result = rollouts.play(game, random);
        EXPECT_NE(result.outcome, Outcome::ongoing);
        if (game.outcome() != Outcome::ongoing) {
            EXPECT_EQ(result.outcome, game.outcome());
        }
        for (const auto owner : result.owners) EXPECT_LE(std::abs(owner), 1);
    });
}

TYPED_TEST(GameContract, EncodingsFillTheirPlanesAndFindEveryMove) {
    if constexpr (Encoded<TypeParam>) {
        this->for_each_position([](const TypeParam& game) {
            for (const auto& encoding : TypeParam::encodings()) {
                const auto shape = encoding.shape(game);
                std::vector<float> planes(shape.planes_size(), std::nanf("")),
                    globals(static_cast<std::size_t>(shape.globals), std::nanf(""));
                encoding.write(game, planes, globals);
                for (const float value : planes) ASSERT_TRUE(std::isfinite(value));
                for (const float value : globals) ASSERT_TRUE(std::isfinite(value));
                for (const Move move : game.legal_moves()) {
                    const int index = encoding.policy_index(game, move);
                    ASSERT_GE(index, 0);
                    ASSERT_LT(index, shape.policy_size);
                }
            }
        });
    } else {
        GTEST_SKIP() << TypeParam::name << " has no encodings";
    }
}
