// Go as text: vertices, positions, rule sets, komi, handicap; and what is refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/engine/go_position.h"

using namespace go;

TEST(GoText, VerticesLeaveOutI) {
    EXPECT_EQ(vertex({0, 0}), "A1");
    EXPECT_EQ(vertex({7, 18}), "H19");
    EXPECT_EQ(vertex({8, 18}), "J19");
    EXPECT_EQ(vertex({24, 24}), "Z25");
    EXPECT_EQ(point_from_vertex("j10", 19), (Point{8, 9}));
    for (const auto* bad :
         {"", "I5", "A0", "A01", "A20", "T20", "U1", "A", "5A", "A-1", "A1x", "A1111", "pass"})
        EXPECT_FALSE(point_from_vertex(bad, 19)) << bad;
}

TEST(GoText, MovesOfAnyCaseAndPass) {
    const Go game(19);
    EXPECT_EQ(game.move_from_text("PaSs"), Go::pass);
    EXPECT_EQ(game.move_from_text("q16"), game.move_at({15, 15}));
    EXPECT_EQ(game.move_to_text(game.move_at({15, 15})), "Q16");
    EXPECT_EQ(game.move_to_text(Go::pass), "pass");
}

TEST(GoText, PositionsSurviveTheirText) {
    Go game = position({". X O .", "X . X O", ". X O .", ". . . ."}, rules_from_text("japanese"),
                       -6.5, Player::second);
    game.set_handicap(4);
    play(game, "B3");
    EXPECT_EQ(game.to_text(), "1XO1/XO1O/1XO1/4 b C3 0:1 -6.5 japanese 4");
    const Go again = Go::from_text(game.to_text());
    EXPECT_EQ(again.to_text(), game.to_text());
    EXPECT_EQ(again.key(), game.key());
}

TEST(GoText, MuchMayBeLeftOutOfAPosition) {
    const Go game = Go::from_text("5/2X2/5/5/5");
    EXPECT_EQ(game.size(), 5);
    EXPECT_EQ(game.to_play(), Player::first);
    EXPECT_EQ(game.komi().points(), 7.5);
    EXPECT_EQ(game.rules(), Rules{});
    EXPECT_EQ(game.at({2, 3}), Player::first);
}

TEST(GoText, RefusesBadPositions) {
    for (const auto* bad :
         {"", "1", "3/3", "2/3", "2/2 x", "2/2 b Z9", "X1/2 b A2", "2/2 b - 1", "2/2 b - x:1",
          "2/2 b - 0:0 7.3", "2/2 b - 0:0 nan", "2/2 b - 0:0 7.5 martian",
          "2/2 b - 0:0 7.5 chinese x", "X?/2", "99999999999/2", "XO/OX", "000/2",
          "26/1/1/1/1/1/1/1/1/1/1/1/1/1/1/1/1/1/1/1/1/1/1/1/1/1/1"})
        EXPECT_THROW(Go::from_text(bad), engine::Error) << bad;
}

TEST(GoText, DiagramShowsTheBoardFromTheTop) {
    Go game(2, Komi::from_points(0.5));
    play(game, "A1");
    EXPECT_EQ(diagram(game),
              "   A B\n 2 . . 2\n 1 X . 1\n   A B\n"
              "White to play, prisoners: Black 0, White 0\nrules chinese, komi 0.5, handicap 0\n");
}

TEST(GoRuleSets, TrompTaylorAsJson) {
    EXPECT_EQ(to_json(rules_from_text("tromp-taylor")),
              R"({"friendlyPassOk":false,"hasButton":false,"ko":"POSITIONAL","scoring":"AREA",)"
              R"("suicide":true,"tax":"NONE","whiteHandicapBonus":"0"})");
}

TEST(GoRuleSets, NamesAndJsonComeBack) {
    for (const auto& named : named_rules()) {
        EXPECT_EQ(rules_from_text(named.name), named.rules);
        EXPECT_EQ(rules_from_text(to_json(named.rules)), named.rules);
        EXPECT_EQ(rules_from_text(describe(named.rules)), named.rules);
    }
    EXPECT_EQ(named_rules().front().name, "chinese");
}

TEST(GoRuleSets, EachNameMeansWhatTheTableSays) {
    const auto json = [](std::string_view name) { return to_json(rules_from_text(name)); };
    EXPECT_EQ(json("chinese"),
              R"({"friendlyPassOk":true,"hasButton":false,"ko":"SIMPLE","scoring":"AREA",)"
              R"("suicide":false,"tax":"NONE","whiteHandicapBonus":"N"})");
    EXPECT_EQ(json("japanese"),
              R"({"friendlyPassOk":false,"hasButton":false,"ko":"SIMPLE","scoring":"TERRITORY",)"
              R"("suicide":false,"tax":"SEKI","whiteHandicapBonus":"0"})");
    EXPECT_EQ(json("aga"),
              R"({"friendlyPassOk":true,"hasButton":false,"ko":"SITUATIONAL","scoring":"AREA",)"
              R"("suicide":false,"tax":"NONE","whiteHandicapBonus":"N-1"})");
    EXPECT_EQ(json("stone-scoring"),
              R"({"friendlyPassOk":true,"hasButton":false,"ko":"SIMPLE","scoring":"AREA",)"
              R"("suicide":false,"tax":"ALL","whiteHandicapBonus":"0"})");
    EXPECT_EQ(json("ing"), json("goe"));
    EXPECT_EQ(json("new-zealand"), json("NZ"));
    EXPECT_EQ(json("Chinese_OGS"), json("chinese-kgs"));
    EXPECT_EQ(json("TrompTaylor"), json("tromp-taylor"));
    EXPECT_EQ(json("bga"), json("aga"));
    EXPECT_EQ(json("korean"), json("japanese"));
    EXPECT_TRUE(rules_from_text("new-zealand").suicide);
}

TEST(GoRuleSets, JsonKeepsWhatItLeavesOut) {
    const auto base = rules_from_text("aga");
    const auto rules = rules_from_text(R"({"suicide":true,"tax":"all","hasButton":false})", base);
    EXPECT_EQ(rules.ko, Ko::situational);
    EXPECT_TRUE(rules.suicide);
    EXPECT_EQ(rules.tax, Tax::all);
}

TEST(GoRuleSets, RefusesWhatItDoesNotKnow) {
    for (const auto* bad :
         {"", "martian", "{", "{}x", "[1]", R"({"ko":"SPIGHT"})", R"({"ko":3})", R"({"ko":null})",
          R"({"suicide":"maybe"})", R"({"colour":"red"})", R"({"whiteHandicapBonus":"N-2"})"})
        EXPECT_THROW(rules_from_text(bad), engine::Error) << bad;
}

TEST(GoRuleSets, RefusesTheButtonByName) {
    for (const auto* bad : {"aga-button", R"({"hasButton":true})"}) try {
            rules_from_text(bad);
            FAIL() << bad;
        } catch (const engine::Error& error) {
            EXPECT_NE(std::string(error.what()).find("button"), std::string::npos);
        }
}

TEST(GoRuleSets, FieldsAreSetOneByOne) {
    Rules rules;
    set_rule(rules, "ko", "positional");
    set_rule(rules, "scoring", "TERRITORY");
    set_rule(rules, "whiteHandicapBonus", "N-1");
    set_rule(rules, "friendlyPassOk", "false");
    EXPECT_EQ(rules.ko, Ko::positional);
    EXPECT_EQ(rules.scoring, Scoring::territory);
    EXPECT_EQ(rules.white_handicap_bonus, HandicapBonus::stones_less_one);
    EXPECT_FALSE(rules.friendly_pass);
}

TEST(GoKomi, IsAMultipleOfOneHalf) {
    EXPECT_EQ(Komi::from_points(-1000).halves(), -2000);
    EXPECT_EQ(Komi::from_points(6.5).points(), 6.5);
    for (const double bad : {6.25, 1000.5, -1e9, std::nan(""), HUGE_VAL})
        EXPECT_THROW(Komi::from_points(bad), engine::Error) << bad;
}

namespace {

std::string names(const std::vector<Point>& points) {
    std::vector<std::string> vertices;
    for (const Point point : points) vertices.push_back(vertex(point));
    return fmt::format("{}", fmt::join(vertices, " "));
}

}  // namespace

TEST(GoHandicap, FixedPointsAreThoseOfGtp) {
    EXPECT_EQ(names(fixed_handicap(19, 2)), "D4 Q16");
    EXPECT_EQ(names(fixed_handicap(19, 3)), "D4 Q16 D16");
    EXPECT_EQ(names(fixed_handicap(19, 4)), "D4 Q16 D16 Q4");
    EXPECT_EQ(names(fixed_handicap(19, 5)), "D4 Q16 D16 Q4 K10");
    EXPECT_EQ(names(fixed_handicap(19, 6)), "D4 Q16 D16 Q4 D10 Q10");
    EXPECT_EQ(names(fixed_handicap(19, 7)), "D4 Q16 D16 Q4 D10 Q10 K10");
    EXPECT_EQ(names(fixed_handicap(19, 8)), "D4 Q16 D16 Q4 D10 Q10 K4 K16");
    EXPECT_EQ(names(fixed_handicap(19, 9)), "D4 Q16 D16 Q4 D10 Q10 K4 K16 K10");
    EXPECT_EQ(names(fixed_handicap(9, 4)), "C3 G7 C7 G3");
    EXPECT_EQ(names(fixed_handicap(12, 2)), "C3 K10");
    EXPECT_EQ(names(fixed_handicap(13, 5)), "D4 K10 D10 K4 G7");
}

TEST(GoHandicap, FixedPointsAreRefusedWhereThereAreNone) {
    for (const auto& [size, stones] : {std::pair(19, 1), {19, 10}, {8, 5}, {7, 5}, {6, 2}, {10, 5}})
        EXPECT_THROW(fixed_handicap(size, stones), engine::Error) << size << ' ' << stones;
    EXPECT_EQ(most_fixed_handicap(7), 4);
    EXPECT_EQ(most_fixed_handicap(9), 9);
    EXPECT_EQ(most_fixed_handicap(10), 4);
}

TEST(GoHandicap, FreePointsAreDistinctPointsOfTheBoard) {
    EXPECT_EQ(names(free_handicap(19, 9)), names(fixed_handicap(19, 9)));
    for (const auto& [size, stones] : {std::pair(2, 3), {5, 24}, {6, 2}, {9, 20}, {19, 25}}) {
        auto points = free_handicap(size, stones);
        EXPECT_EQ(static_cast<int>(points.size()), stones);
        for (std::size_t i = 0; i < points.size(); ++i) {
            EXPECT_TRUE(point_from_vertex(vertex(points[i]), size));
            EXPECT_EQ(std::find(points.begin(), points.begin() + static_cast<long>(i), points[i]),
                      points.begin() + static_cast<long>(i));
        }
    }
    EXPECT_THROW(free_handicap(5, 25), engine::Error);
    EXPECT_THROW(free_handicap(5, 1), engine::Error);
}
