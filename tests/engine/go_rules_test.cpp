// The rules of Go by board diagrams.
#include <gtest/gtest.h>

#include "tests/engine/go_position.h"

using namespace go;

namespace {

using Rows = std::vector<std::string>;

Go ko_fight(const Rules& rules, Player to_play = Player::first) {
    return position({". X O .",  //
                     "X . X O",  //
                     ". X O .",  //
                     ". . . ."},
                    rules, 0, to_play);
}

}  // namespace

TEST(GoRules, AStoneWithoutLibertyIsTaken) {
    Go game = position({". X .",  //
                        "X O .",  //
                        ". X ."});
    play(game, "C2");
    EXPECT_EQ(rows_of(game), (Rows{".X.", "X.X", ".X."}));
    EXPECT_EQ(game.captured_by(Player::first), 1);
    EXPECT_EQ(game.captured_by(Player::second), 0);
}

TEST(GoRules, OneMoveTakesSeveralChains) {
    Go game = position({"O O . O",  //
                        "X X O X",  //
                        ". . X .",  //
                        ". . . ."});
    play(game, "C4");
    EXPECT_EQ(rows_of(game), (Rows{"..X.", "XX.X", "..X.", "...."}));
    EXPECT_EQ(game.captured_by(Player::first), 4);
}

TEST(GoRules, TakingComesBeforeSuicide) {
    Go game = position({". O X",  //
                        "O X X",  //
                        "X . ."});
    EXPECT_EQ(why_illegal(game, "A3"), "");
    play(game, "A3");
    EXPECT_EQ(rows_of(game), (Rows{"X.X", ".XX", "X.."}));
}

TEST(GoRules, OccupiedPointsAreNoMoves) {
    Go game(5);
    play(game, "C3");
    EXPECT_EQ(why_illegal(game, "C3"), "occupied");
    EXPECT_FALSE(game.move_from_text("C3"));
    EXPECT_EQ(game.legal_moves().size(), 25);
    EXPECT_TRUE(game.legal_moves().contains(Go::pass));
}

TEST(GoRules, ALoneStoneNeverKillsItself) {
    for (const bool suicide : {false, true})
        EXPECT_EQ(why_illegal(
                      position({". O .", "O . O", ". O ."}, rules_with(Ko::simple, suicide)), "B2"),
                  "suicide");
}

TEST(GoRules, SuicideOfAChainWhereTheRulesAllowIt) {
    const Rows rows{"X . O",  //
                    "O O .",  //
                    ". . ."};
    EXPECT_EQ(why_illegal(position(rows), "B3"), "suicide");
    Go game = position(rows, rules_with(Ko::simple, true));
    play(game, "B3");
    EXPECT_EQ(rows_of(game), (Rows{"..O", "OO.", "..."}));
    EXPECT_EQ(game.captured_by(Player::second), 2);
}

TEST(GoRules, SuicideObeysSuperko) {
    Go game = position({". . O",  //
                        "O O .",  //
                        ". . ."},
                       rules_with(Ko::positional, true));
    play(game, "A3 pass");
    // The suicide of A3 and B3 would leave the position before A3.
    EXPECT_EQ(why_illegal(game, "B3"), "superko");
    game.set_rules(rules_with(Ko::simple, true));
    EXPECT_EQ(why_illegal(game, "B3"), "");
}

TEST(GoRules, SimpleKoForbidsTakingBackAtOnce) {
    Go game = ko_fight({}, Player::second);
    play(game, "B3");
    EXPECT_EQ(rows_of(game)[1], "XO.O");
    EXPECT_EQ(why_illegal(game, "C3"), "ko");
    EXPECT_EQ(game.ko_point(), (Point{2, 2}));
    play(game, "A1 D1");
    EXPECT_FALSE(game.ko_point());
    EXPECT_EQ(why_illegal(game, "C3"), "");
}

TEST(GoRules, EveryKoRuleForbidsTakingBackAtOnce) {
    for (const auto ko : {Ko::simple, Ko::positional, Ko::situational}) {
        Go game = ko_fight(rules_with(ko), Player::second);
        play(game, "B3");
        EXPECT_NE(why_illegal(game, "C3"), "");
    }
}

TEST(GoRules, TakingTwoStonesOrWithAChainIsNoKo) {
    Go two = position({"X X O .",  //
                       ". O . .",  //
                       "O . . .",  //
                       ". . . ."},
                      {}, 0, Player::second);
    play(two, "A3");
    EXPECT_FALSE(two.ko_point());
    EXPECT_EQ(why_illegal(two, "A4"), "");
}

TEST(GoRules, SnapbackTakesTheTaker) {
    Go game = position({". . . . .",  //
                        ". . . . .",  //
                        "O O O O O",  //
                        "O X X X O",  //
                        "O X . . O"},
                       {}, 0, Player::second);
    play(game, "C1 D1");
    EXPECT_EQ(game.captured_by(Player::first), 1);
    EXPECT_FALSE(game.ko_point());
    play(game, "C1");
    EXPECT_EQ(game.captured_by(Player::second), 5);
    EXPECT_EQ(rows_of(game), (Rows{".....", ".....", "OOOOO", "O...O", "O.O.O"}));
}

namespace {

// White can send two stones, A1 and B1, and take one back at B1 for ever.
Go sending_two(Ko ko) {
    return position({". . . .",  //
                     "X X O O",  //
                     "X X O O",  //
                     ". O . O"},
                    rules_with(ko), 0, Player::second);
}

}  // namespace

TEST(GoRules, PositionalSuperkoForbidsSendingTwoReturningOne) {
    Go game = sending_two(Ko::positional);
    play(game, "A1 C1");
    EXPECT_EQ(why_illegal(game, "B1"), "superko");
}

TEST(GoRules, SituationalSuperkoAsksWhoseMoveItIs) {
    Go game = sending_two(Ko::situational);
    play(game, "A1 C1 B1 pass");
    EXPECT_EQ(why_illegal(game, "A1"), "superko");
}

TEST(GoRules, ThirdOccurrenceUnderSimpleKoIsNoResult) {
    Go game = sending_two(Ko::simple);
    play(game, "A1 C1 B1 pass A1 C1 B1 pass");
    EXPECT_FALSE(game.no_result());
    EXPECT_EQ(game.outcome(), Outcome::ongoing);
    play(game, "A1");
    EXPECT_TRUE(game.no_result());
    EXPECT_EQ(game.outcome(), Outcome::draw);
    play(game, "A4");
    EXPECT_FALSE(game.no_result());
}

TEST(GoRules, PassesEndTheGameYetItMayGoOn) {
    Go game(5);
    play(game, "pass");
    EXPECT_EQ(game.outcome(), Outcome::ongoing);
    play(game, "pass");
    EXPECT_EQ(game.outcome(), Outcome::second_wins);
    EXPECT_EQ(game.consecutive_passes(), 2);
    play(game, "C3");
    EXPECT_EQ(game.outcome(), Outcome::ongoing);
    EXPECT_EQ(game.move_count(), 3);
}

TEST(GoRules, SetUpStartsTheHistoryAnew) {
    Go game = ko_fight(rules_with(Ko::positional), Player::second);
    play(game, "B3");
    game.set_up({3, 0}, Player::second);
    EXPECT_EQ(why_illegal(game, "C3"), "");
    EXPECT_EQ(game.move_count(), 0);
    game.set_up({3, 0}, {});
    EXPECT_EQ(rows_of(game)[3], "....");
    EXPECT_TRUE(game.every_chain_has_liberty());
}

TEST(GoRules, ChainsWithoutLibertyAreSeen) {
    EXPECT_FALSE(position({"X O", "O ."}).every_chain_has_liberty());
    EXPECT_TRUE(position({"X .", "O ."}).every_chain_has_liberty());
}

TEST(GoRules, ThePlayerToMoveCanBeChanged) {
    Go game(5);
    game.set_to_play(Player::second);
    play(game, "A1");
    EXPECT_EQ(game.at({0, 0}), Player::second);
    EXPECT_EQ(game.to_play(), Player::first);
}

TEST(GoRules, OwnEyesAreFilledByWhoFillsThem) {
    const Go game = position({". X . X .",  //
                              "X X X O X",  //
                              "O X . X .",  //
                              ". O X . .",  //
                              ". . . . ."});
    EXPECT_TRUE(game.fills_own_eye(at(game, "A5")));
    EXPECT_FALSE(game.fills_own_eye(at(game, "C5")));  // white beside and below
    EXPECT_FALSE(game.fills_own_eye(at(game, "E5")));  // at the edge one enemy diagonal is enough
    EXPECT_FALSE(game.fills_own_eye(at(game, "C3")));  // two enemy diagonals
    EXPECT_FALSE(game.fills_own_eye(Go::pass));
    Go white = game;
    white.set_to_play(Player::second);
    EXPECT_FALSE(white.fills_own_eye(at(white, "A5")));
}

TEST(GoRules, KeysTellPositionsMoversAndKosApart) {
    Go one(9), other(9);
    play(one, "C3 D4 E5");
    play(other, "E5 D4 C3");
    EXPECT_EQ(one.key(), other.key());
    play(one, "pass");
    EXPECT_NE(one.key(), other.key());
    EXPECT_NE(Go(9).key(), Go(13).key());

    Go with_ko = ko_fight({}, Player::second);
    play(with_ko, "B3");
    Go without_ko = position(rows_of(with_ko));
    EXPECT_NE(with_ko.key(), without_ko.key());
}
