// Scoring by board diagrams: Benson's chains, territory, seki, group tax, dead stones, handicap.
#include <gtest/gtest.h>

#include "engine/go/score.h"
#include "tests/engine/go_position.h"

using namespace go;

namespace {

using Rows = std::vector<std::string>;

Rows rows_of(const std::vector<std::optional<Player>>& owners, int size) {
    Rows rows(static_cast<std::size_t>(size));
    for (std::size_t i = 0; i < owners.size(); ++i)
        rows[rows.size() - 1 - i / rows.size()] += !owners[i]                    ? '.'
                                                   : *owners[i] == Player::first ? 'X'
                                                                                 : 'O';
    return rows;
}

std::string score_under(const Rows& rows, std::string_view rules, double komi = 0) {
    return score(position(rows, rules_from_text(rules), komi)).text();
}

std::string score_with_tax(const Rows& rows, Scoring scoring, Tax tax) {
    Rules rules;
    rules.scoring = scoring;
    rules.tax = tax;
    return score(position(rows, rules)).text();
}

}  // namespace

TEST(GoPassAlive, TwoEyesLiveAndOneDoesNot) {
    const auto game = position({". X . X O",  //
                                "X X X X O",  //
                                "O O O O O",  //
                                ". . . . .",  //
                                ". O . . ."});
    EXPECT_EQ(rows_of(pass_alive(game), 5), (Rows{"XXXX.", "XXXX.", ".....", ".....", "....."}));
}

TEST(GoPassAlive, ChainsShareTheirEyes) {
    const auto game = position({". X O . .",  //
                                "X . X O .",  //
                                "X X X O .",  //
                                "O O O . .",  //
                                ". . . . ."});
    EXPECT_EQ(rows_of(pass_alive(game), 5), (Rows{"XX...", "XXX..", "XXX..", ".....", "....."}));
}

TEST(GoPassAlive, AFalseEyeIsNone) {
    const auto game = position({". X O . .",  //
                                "X O X O .",  //
                                ". X X O .",  //
                                "O O O . .",  //
                                ". . . . ."});
    EXPECT_EQ(rows_of(pass_alive(game), 5), Rows(5, "....."));
}

TEST(GoPassAlive, WhereSuicideIsAllowedEnemyStonesMayVanish) {
    const Rows rows{"O . X . X",  //
                    ". . X X X",  //
                    "X X X . .",  //
                    ". . . . .",  //
                    ". . . . ."};
    EXPECT_EQ(rows_of(pass_alive(position(rows)), 5), Rows(5, "XXXXX"));
    EXPECT_EQ(rows_of(pass_alive(position(rows, rules_with(Ko::simple, true))), 5),
              Rows(5, "....."));
}

TEST(GoPassAlive, NobodyOwnsTheEmptyBoard) {
    EXPECT_EQ(rows_of(pass_alive(Go(3)), 3), Rows(3, "..."));
    EXPECT_EQ(score(Go(3, Komi::from_points(0))).text(), "0");
}

TEST(GoScore, AreaCountsStonesAndTerritory) {
    const Rows rows{". X O . .",  //
                    ". X O . .",  //
                    ". X . O .",  //
                    ". X O . .",  //
                    ". X O . ."};
    const auto result = score(position(rows));
    EXPECT_EQ(rows_of(result.owners, 5), (Rows{"XXOOO", "XXOOO", "XX.OO", "XXOOO", "XXOOO"}));
    EXPECT_EQ(result.text(), "W+4.0");
    EXPECT_EQ(score_under(rows, "chinese", -4), "0");
    EXPECT_EQ(score_under(rows, "chinese", -4.5), "B+0.5");
    EXPECT_EQ(score_under(rows, "chinese", 7.5), "W+11.5");
}

TEST(GoScore, OutcomeFollowsTheLead) {
    EXPECT_EQ((Score{{}, 1}.outcome()), Outcome::first_wins);
    EXPECT_EQ((Score{{}, 0}.outcome()), Outcome::draw);
    EXPECT_EQ((Score{{}, -3}.outcome()), Outcome::second_wins);
    EXPECT_EQ((Score{{}, -3}.text()), "W+1.5");
}

TEST(GoScore, TerritoryCountsPrisonersAndNotStones) {
    Go game = position({". X O . .",  //
                        "O X O . .",  //
                        ". X O . .",  //
                        ". X O . .",  //
                        ". X O . ."},
                       rules_from_text("japanese"));
    play(game, "A3");
    // Four empty points and nothing taken yet; White's A4 is in atari but stands.
    EXPECT_EQ(game.captured_by(Player::first), 0);
    play(game, "pass A5");
    EXPECT_EQ(game.captured_by(Player::first), 1);
    // Black: three points and a prisoner. White: ten points.
    EXPECT_EQ(score(game).text(), "W+6.0");
    game.set_rules(rules_from_text("chinese"));
    EXPECT_EQ(score(game).text(), "W+5.0");
}

TEST(GoScore, DeadStonesBecomePrisoners) {
    const Rows rows{". X O . .",  //
                    ". X O . .",  //
                    "O X O . .",  //
                    ". X O . .",  //
                    ". X O . ."};
    const std::vector<Point> dead{{0, 2}};
    EXPECT_EQ(score(position(rows), dead).text(), "W+5.0");
    EXPECT_EQ(score(position(rows, rules_from_text("japanese")), dead).text(), "W+4.0");
    EXPECT_EQ(score(position(rows)).text(), "W+11.0");
    EXPECT_EQ(score(position(rows), std::vector<Point>{{0, 0}}).text(), "W+11.0");
}

TEST(GoScore, EnemyStonesInsideLivingChainsCountAsTaken) {
    // Black lives by A5, C5 and E5; nothing White has below could ever live.
    const Rows rows{". X . X .",  //
                    "X X X X X",  //
                    ". . . O .",  //
                    "X X X X X",  //
                    "X . X . X"};
    EXPECT_EQ(score_under(rows, "tromp-taylor"), "B+25.0");
    // Black: the ten empty points, and D3 with its prisoner.
    EXPECT_EQ(score_with_tax(rows, Scoring::territory, Tax::none), "B+11.0");
}

TEST(GoScore, SekiGivesStonesButNoEyes) {
    const Rows rows{". X O O",  //
                    "X X O O",  //
                    "X . . O",  //
                    "X X O O"};
    EXPECT_EQ(score_with_tax(rows, Scoring::area, Tax::none), "0");
    EXPECT_EQ(score_with_tax(rows, Scoring::area, Tax::seki), "W+1.0");
    EXPECT_EQ(score_with_tax(rows, Scoring::area, Tax::all), "W+1.0");
    EXPECT_EQ(score_with_tax(rows, Scoring::territory, Tax::none), "B+1.0");
    EXPECT_EQ(score_with_tax(rows, Scoring::territory, Tax::seki), "0");
}

TEST(GoScore, GroupTaxTakesTwoPointsFromEachGroup) {
    const Rows rows(7, ". X O . O X .");
    EXPECT_EQ(score_with_tax(rows, Scoring::area, Tax::none), "B+7.0");
    EXPECT_EQ(score_with_tax(rows, Scoring::area, Tax::seki), "B+7.0");
    EXPECT_EQ(score_with_tax(rows, Scoring::area, Tax::all), "B+5.0");
    EXPECT_EQ(score_with_tax(rows, Scoring::territory, Tax::none), "B+7.0");
    EXPECT_EQ(score_with_tax(rows, Scoring::territory, Tax::all), "B+5.0");
    EXPECT_EQ(score_under(rows, "stone-scoring"), "B+5.0");
    EXPECT_EQ(score_under(rows, "ancient-territory"), "B+5.0");
    EXPECT_EQ(score_under(rows, "tromp-taylor", 7.5), "W+0.5");
}

// Black may make A2 A1 B1 C1 a bent four whenever it suits; White can do nothing.
TEST(GoScore, BentFourInTheCorner) {
    const Rows rows{". X . X . X",  //
                    "X X X X X X",  //
                    "X X X X X X",  //
                    "O O X X X X",  //
                    ". O O O O X",  //
                    "X X X . O X"};
    std::vector<Point> white;
    for (const auto* stone : {"A3", "B3", "B2", "C2", "D2", "E2", "E1"})
        white.push_back(point_from_vertex(stone, 6).value());
    const Go chinese = position(rows), japanese = position(rows, rules_from_text("japanese"));
    EXPECT_EQ(score(chinese).text(), "B+20.0");
    EXPECT_EQ(score(chinese, white).text(), "B+36.0");
    EXPECT_EQ(score(japanese).text(), "B+3.0");
    EXPECT_EQ(score(japanese, white).text(), "B+19.0");
}

TEST(GoScore, HandicapIsPaidForAsTheRulesSay) {
    const auto bonus = [](std::string_view rules, int stones) {
        Go game(9, {}, rules_from_text(rules));
        game.set_handicap(stones);
        return game.white_bonus();
    };
    EXPECT_EQ(bonus("chinese", 4), 4);
    EXPECT_EQ(bonus("aga", 4), 3);
    EXPECT_EQ(bonus("japanese", 4), 0);
    EXPECT_EQ(bonus("chinese", 0), 0);
    EXPECT_EQ(bonus("chinese", 1), 0);

    Go game = position({". X O . .", ". X O . .", ". X O . .", ". X O . .", ". X O . ."});
    game.set_handicap(2);
    EXPECT_EQ(score(game).text(), "W+7.0");
}
