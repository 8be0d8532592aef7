// AlphaGo's planes of Go on diagrams: each feature alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "engine/base/random.h"
#include "engine/go/alphago_planes.h"
#include "engine/go/symmetry.h"
#include "tests/engine/go_position.h"

namespace go {
namespace {

std::vector<float> planes_of(const Go& game, const char* name = "alphago48") {
    const auto& encoding = engine::find_encoding<Go>(name);
    std::vector<float> planes(encoding.shape(game).planes_size(), -1.0f);
    encoding.write(game, planes, {});
    return planes;
}

float value_at(const std::vector<float>& planes, int size, int plane, Point point) {
    return planes[static_cast<std::size_t>((plane * size + point.y) * size + point.x)];
}

using Rows = std::vector<std::string>;

// Rows from the top: the number that a group of eight planes shows, '.' where it shows none.
Rows numbers(const Go& game, int first) {
    const auto planes = planes_of(game);
    Rows rows;
    for (int y = game.size() - 1; y >= 0; --y) {
        std::string row;
        for (int x = 0; x < game.size(); ++x) {
            char shown = '.';
            for (int i = 0; i < 8; ++i)
                if (value_at(planes, game.size(), first + i, {x, y}) != 0) {
                    EXPECT_EQ(shown, '.') << "two numbers at once";
                    shown = static_cast<char>('1' + i);
                }
            row += shown;
        }
        rows.push_back(row);
    }
    return rows;
}

// Likewise, '1' where the plane is set.
Rows plane(const Go& game, int index) {
    const auto planes = planes_of(game);
    Rows rows;
    for (int y = game.size() - 1; y >= 0; --y) {
        std::string row;
        for (int x = 0; x < game.size(); ++x)
            row += value_at(planes, game.size(), index, {x, y}) != 0 ? '1' : '.';
        rows.push_back(row);
    }
    return rows;
}

Rows all(int size, char c) {
    return Rows(static_cast<std::size_t>(size), std::string(static_cast<std::size_t>(size), c));
}

TEST(AlphaGoPlanes, Shapes) {
    for (const int size : {2, 9, 19, 25}) {
        const auto shape = engine::find_encoding<Go>("alphago48").shape(Go(size));
        EXPECT_EQ(shape.planes, 48);
        EXPECT_EQ(shape.policy_size, size * size + 1);
        EXPECT_EQ(shape.symmetries, 8);
        EXPECT_EQ(engine::find_encoding<Go>("alphago49").shape(Go(size)).planes, 49);
    }
}

TEST(AlphaGoPlanes, StonesOnesAndZeros) {
    const auto game = position({"X.O", "...", "..O"}, {}, 0, Player::second);
    EXPECT_EQ(plane(game, alphago::own), (Rows{"..1", "...", "..1"}));
    EXPECT_EQ(plane(game, alphago::enemy), (Rows{"1..", "...", "..."}));
    EXPECT_EQ(plane(game, alphago::empty), (Rows{".1.", "111", "11."}));
    EXPECT_EQ(plane(game, alphago::ones), all(3, '1'));
    EXPECT_EQ(plane(game, alphago::zeros), all(3, '.'));
}

TEST(AlphaGoPlanes, TurnsSinceAStoneWasPlayed) {
    Go game(5);
    play(game, "A1 E5 B1 E4 C1 E3 D1 E2 D2 pass A5");
    // The last move is 1 turn old, D2 three (White passed between), those up to E4 8 or more.
    EXPECT_EQ(numbers(game, alphago::turns_since),
              (Rows{"1...8", "....8", "....6", "...34", "8875."}));
    Go set_up = position({"XO", ".."});
    EXPECT_EQ(numbers(set_up, alphago::turns_since), (Rows{"88", ".."}));
}

TEST(AlphaGoPlanes, Liberties) {
    const auto game = position({".....", ".XX..", ".....", "O....", "X...."});
    EXPECT_EQ(numbers(game, alphago::liberties),
              (Rows{".....", ".66..", ".....", "2....", "1...."}));
}

TEST(AlphaGoPlanes, LibertiesEightOrMore) {
    const auto game =
        position({".......", ".XXXX..", ".......", ".......", ".......", ".......", "......."});
    EXPECT_EQ(numbers(game, alphago::liberties)[1], ".8888..");
}

TEST(AlphaGoPlanes, CaptureSize) {
    // A5 takes two stones; E1 takes one.
    const auto game = position({".OOX.", "XXX..", ".....", "...X.", "..XO."}, {}, 0);
    EXPECT_EQ(numbers(game, alphago::capture_size),
              (Rows{"2....", ".....", ".....", ".....", "....1"}));
}

TEST(AlphaGoPlanes, SelfAtariSize) {
    // A stone in the corner would stand alone in atari, one beside two own ones with them.
    const auto game = position({"..OX.", "O.OX.", "OXXO.", "OOOO.", "....."});
    const auto sizes = numbers(game, alphago::self_atari_size);
    EXPECT_EQ(sizes[1][1], '3');  // B4 joins B3 and C3; B5 is left
    EXPECT_EQ(sizes[0][0], '1');  // A5: B5 is left
}

TEST(AlphaGoPlanes, LibertiesAfterTheMove) {
    const auto game = position({"...", ".X.", "..O"}, {}, 0, Player::first);
    // C2 makes a chain with B2 that has A2, B3, B1 and C3; at B1 C1 is White's.
    EXPECT_EQ(numbers(game, alphago::liberties_after), (Rows{"252", "5.4", "24."}));
}

TEST(AlphaGoPlanes, LibertiesAfterACapture) {
    // A1 takes B1, which becomes a liberty.
    const auto game = position({"...", "XX.", ".OX"});
    EXPECT_EQ(numbers(game, alphago::capture_size)[2][0], '1');
    EXPECT_EQ(numbers(game, alphago::liberties_after)[2][0], '4');  // B1, C2, A3, B3
}

TEST(AlphaGoPlanes, LadderCapture) {
    // From D3 White's C3 is driven up and to the right, to the edge; from C4 it gets away.
    const Rows open = {".........", ".........", ".........", ".........", ".........",
                       ".X.......", ".XO......", "..X......", "........."};
    auto expected = all(9, '.');
    expected[6] = "...1.....";
    EXPECT_EQ(plane(position(open), alphago::ladder_capture), expected);
    Rows broken = open;
    broken[3] = ".....O...";  // in the ladder's way
    broken[4] = "....OO...";
    EXPECT_EQ(plane(position(broken), alphago::ladder_capture), all(9, '.'));
}

TEST(AlphaGoPlanes, LadderEscape) {
    // C7 is in atari; D7 runs into a ladder unless a stone of its own waits on the way.
    const Rows chased = {".........", "..O......", ".OX......", "..OO.....", ".........",
                         ".........", ".........", ".........", "........."};
    EXPECT_EQ(plane(position(chased), alphago::ladder_escape), all(9, '.'));
    Rows helped = chased;
    helped[2] = ".OX.X....";
    EXPECT_EQ(plane(position(helped), alphago::ladder_escape)[2], "...1.....");
}

TEST(AlphaGoPlanes, EscapeByCapture) {
    // C1 is in atari; taking B1 at A1 saves it.
    const auto game = position({".....", ".....", ".X...", "XXO..", ".OX.."}, {}, 0);
    const auto shown = plane(game, alphago::ladder_escape);
    EXPECT_EQ(shown[4][0], '1');
}

TEST(AlphaGoPlanes, SensibleIsLegalAndNoOwnEye) {
    // A1 is Black's eye, C1 White's point of suicide for Black.
    const auto game = position({"...OO", "...O.", "XX.OO", ".X.O.", "XX.OO"});
    const auto shown = plane(game, alphago::sensible);
    EXPECT_EQ(shown, (Rows{"111..", "111..", "..1..", "..1..", "..1.."}));
}

TEST(AlphaGoPlanes, KoIsNotSensible) {
    auto game = position({".....", ".XO..", "XO.O.", ".XO..", "....."});
    play(game, "C3");
    // White may not take back at B3.
    EXPECT_EQ(plane(game, alphago::sensible)[2][1], '.');
    EXPECT_EQ(numbers(game, alphago::liberties_after)[2][1], '.');
}

TEST(AlphaGoPlanes, ColourOfTheMover) {
    for (const auto player : {Player::first, Player::second}) {
        const auto game = position({"X.", ".."}, {}, 0, player);
        const auto planes = planes_of(game, "alphago49");
        for (int at = 0; at < 4; ++at)
            EXPECT_EQ(value_at(planes, 2, alphago::colour, {at % 2, at / 2}),
                      player == Player::first ? 1 : 0);
        const auto policy = planes_of(game);
        EXPECT_TRUE(std::equal(policy.begin(), policy.end(), planes.begin()));
    }
}

TEST(AlphaGoPlanes, TurnWithTheBoard) {
    engine::Random random(9);
    for (int symmetry = 0; symmetry < symmetries; ++symmetry) {
        Go game(7), twin(7);
        for (int ply = 0; ply < 60 && game.outcome() == Outcome::ongoing; ++ply) {
            const auto planes = planes_of(game), turned = planes_of(twin);
            for (int index = 0; index < 48; ++index)
                for (int at = 0; at < 49; ++at) {
                    const Point point{at % 7, at / 7};
                    ASSERT_EQ(value_at(planes, 7, index, point),
                              value_at(turned, 7, index, transformed(point, 7, symmetry)))
                        << index;
                }
            const auto moves = game.legal_moves();
            const Move move = moves[random.below(moves.size())];
            twin.play(transformed(game, move, symmetry));
            game.play(move);
        }
    }
}

}  // namespace
}  // namespace go
