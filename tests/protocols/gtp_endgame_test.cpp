// How games of Go end over GTP: passing, dead stones, scores that agree, resignation.
#include <gtest/gtest.h>

#include "tests/protocols/gtp_guest.h"

namespace protocols {

namespace {

// All chains live but the single stones in the middle of the fifth row, which no play saves.
constexpr std::string_view both_have_dead[] = {
    ". X X X X O O O .",  //
    "X . X X X O O . O",  //
    "X X X X X O O O O",  //
    "X X X X X O O O O",  //
    ". O . X X O . X .",  //
    "X X X X X O O O O",  //
    "X X X X X O O O O",  //
    "X . X X X O O . O",  //
    ". X X X X O O O .",
};

// Black lives, but White's stone at A5 counts until it is taken: Benson's rule does not see it.
constexpr std::string_view one_to_take[] = {
    ". X X X X O O O .",  //
    "X X X X X O O . O",  //
    "X X X X X O O O O",  //
    ". . . X X O O O O",  //
    "O . . X X O O O O",  //
    ". . . X X O O O O",  //
    "X X X X X O O O O",  //
    "X X X X X O O . O",  //
    "X X X X X O O O .",
};

// set_position of a diagram, its stone at `without` left out.
std::string setup(std::span<const std::string_view> rows, std::string_view without = "") {
    std::string command = "set_position";
    for (std::size_t row = 0; row < rows.size(); ++row)
        for (std::size_t x = 0; x < rows.size(); ++x) {
            const char stone = rows[row][2 * x];
            const auto point =
                go::vertex({static_cast<int>(x), static_cast<int>(rows.size() - 1 - row)});
            if (stone != '.' && point != without) command += (stone == 'X' ? " b " : " w ") + point;
        }
    return command;
}

std::string result_in_sgf(GtpGuest& guest) {
    const auto text = guest.ask("printsgf");
    const auto at = text.find("RE[");
    return at == text.npos ? "" : text.substr(at + 3, text.find(']', at) - at - 3);
}

}  // namespace

TEST(GtpEndgame, TheWinnerPassesOverDeadStonesUnderChineseRules) {
    for (const int simulations : {300, 1000, 3000}) {
        GtpGuest guest(small_game(9, static_cast<std::uint64_t>(simulations)));
        ASSERT_EQ(guest.say(setup(both_have_dead)), "=");
        EXPECT_EQ(guest.ask("genmove b"), "pass") << simulations;
        guest.say("play w pass");
        EXPECT_EQ(guest.ask("final_score"), "B+1.5");
        EXPECT_EQ(result_in_sgf(guest), "B+1.5");
        EXPECT_EQ(guest.ask("final_status_list dead"), "B5 H5");
        EXPECT_EQ(guest.ask("final_status_list seki"), "=");
        EXPECT_EQ(guest.ask("final_status b5"), "dead");
        EXPECT_EQ(guest.ask("final_status d5"), "alive");
    }
}

TEST(GtpEndgame, WinnerAndLoserPassOverDeadStonesWhateverTheSimulations) {
    for (const char* rules : {"chinese", "japanese"})
        for (const int simulations : {300, 600, 2000, 4000}) {
            GtpGuest guest(small_game(9, static_cast<std::uint64_t>(simulations)));
            guest.say(std::string("kata-set-rules ") + rules);
            ASSERT_EQ(guest.say(setup(both_have_dead)), "=");
            for (const char* colour : {"b", "w"})
                EXPECT_EQ(guest.ask(std::string("reg_genmove ") + colour), "pass")
                    << colour << simulations << rules;
        }
}

TEST(GtpEndgame, BothSidesCleanUpUnderTrompTaylorAndKeepTheirEyes) {
    for (const int simulations : {300, 1000, 2000}) {
        GtpGuest guest(small_game(9, static_cast<std::uint64_t>(simulations)));
        guest.say("kata-set-rules tromp-taylor");
        ASSERT_EQ(guest.say(setup(both_have_dead)), "=");
        int moves = 0, passes = 0;
        for (; passes < 2; ++moves) {
            ASSERT_LT(moves, 12) << guest.ask("showboard");
            const auto move = guest.ask(moves % 2 == 0 ? "genmove b" : "genmove w");
            passes = move == "pass" ? passes + 1 : 0;
        }
        EXPECT_EQ(guest.ask("captures b"), "1");
        EXPECT_EQ(guest.ask("captures w"), "1");
        EXPECT_EQ(guest.ask("final_score"), "B+1.5");
    }
}

TEST(GtpEndgame, NoOwnEyeIsFilledByASideThatHasLost) {
    GtpGuest guest(small_game(9, 300));
    guest.say("kata-set-rules tromp-taylor");
    ASSERT_EQ(guest.say(setup(one_to_take)), "=");
    for (int i = 0; i < 2; ++i) {
        const auto move = guest.ask("reg_genmove w");
        for (const auto* eye : {"J9", "H8", "J1", "H2"}) EXPECT_NE(move, eye);
    }
}

// Opponents that know no such rule would call it an illegal move.
TEST(GtpEndgame, PlaysNoSuicideWhereItIsLegal) {
    constexpr std::string_view only_suicide_left[] = {
        "X . O O .",  //
        "O O O O O",  //
        "O O O O O",  //
        "O O O O O",  //
        ". O O O O",
    };
    GtpGuest guest(small_game(5, 100));
    guest.say("kata-set-rules tromp-taylor");
    ASSERT_EQ(guest.say(setup(only_suicide_left)), "=");
    EXPECT_EQ(guest.ask("is_legal b b5"), "1");
    EXPECT_EQ(guest.ask("genmove b"), "pass");
}

TEST(GtpEndgame, TheScoreIsTheBoardWithoutTheDeadStones) {
    for (const auto& [rules, result] : {std::pair{"chinese", "B+1.5"}, {"japanese", "W+7.5"}}) {
        GtpGuest guest;
        guest.say(std::string("kata-set-rules ") + rules);
        ASSERT_EQ(guest.say(setup(both_have_dead)), "=");
        guest.say("gogui-play_sequence b pass w pass");
        EXPECT_EQ(guest.ask("final_score"), result) << rules;
        EXPECT_EQ(result_in_sgf(guest), result);
        EXPECT_EQ(guest.ask("final_status_list dead"), "B5 H5");
    }
}

TEST(GtpEndgame, UnderTrompTaylorNoDeadStoneIsLeftToCount) {
    GtpGuest guest(small_game(9, 1500));
    guest.say("kata-set-rules tromp-taylor");
    ASSERT_EQ(guest.say(setup(one_to_take)), "=");
    guest.say("gogui-play_sequence b pass w pass");
    EXPECT_EQ(guest.ask("final_score"), "W+8.5");
    EXPECT_EQ(result_in_sgf(guest), "W+8.5");

    ASSERT_EQ(guest.say(setup(one_to_take)), "=");
    int moves = 0;
    for (; guest.ask("genmove b") != "pass"; ++moves) {
        ASSERT_LT(moves, 9) << guest.ask("showboard");
        guest.say("play w pass");
    }
    // Until the stone is taken, or shut in beyond the doubts of Benson's rule.
    EXPECT_GT(moves, 0);
    guest.say("play w pass");
    EXPECT_EQ(guest.ask("final_score"), "B+1.5");
    EXPECT_EQ(result_in_sgf(guest), "B+1.5");
}

TEST(GtpEndgame, CleaningUpTakesTheOpponentsDeadStones) {
    GtpGuest guest;
    ASSERT_EQ(guest.say(setup(both_have_dead)), "=");
    int moves = 0;
    for (; guest.ask("kgs-genmove_cleanup b") != "pass"; ++moves) {
        ASSERT_LT(moves, 3) << guest.ask("showboard");
        guest.say("play w pass");
    }
    EXPECT_EQ(moves, 2);
    EXPECT_EQ(guest.ask("captures b"), "1");
    EXPECT_EQ(guest.ask("final_status_list dead"), "H5");
    EXPECT_EQ(guest.ask("final_score"), "B+1.5");
}

// Rules that ask for agreement do not help where nobody asks: who plays on wants it played out.
TEST(GtpEndgame, PlayAfterItsPassIsAnsweredByCaptures) {
    GtpGuest guest(small_game(9, 1500));
    ASSERT_EQ(guest.say(setup(both_have_dead)), "=");
    EXPECT_EQ(guest.ask("genmove b"), "pass");
    guest.say("play w j5");
    int moves = 0;
    for (; guest.ask("genmove b") != "pass"; ++moves) {
        ASSERT_LT(moves, 3) << guest.ask("showboard");
        guest.say("play w pass");
    }
    EXPECT_EQ(guest.ask("captures b"), "1");
}

TEST(GtpEndgame, APassIsAnsweredByAPassThatWins) {
    for (const char* rules : {"chinese", "tromp-taylor", "japanese"}) {
        GtpGuest guest;
        guest.say(std::string("kata-set-rules ") + rules);
        guest.say("gogui-play_sequence b e5 w pass");
        EXPECT_EQ(guest.ask("genmove b"), "pass") << rules;
        EXPECT_TRUE(guest.ask("final_score").starts_with("B+"));
    }
}

TEST(GtpEndgame, APassIsNotAnsweredByOneThatLoses) {
    GtpGuest guest;
    guest.say("gogui-play_sequence w e5 b e4 w pass");
    EXPECT_NE(guest.ask("genmove b"), "pass");
    // With its dead stones Black has more of this board, without them less.
    GtpGuest settled;
    settled.say("komi 9.5");
    settled.say(setup(both_have_dead, "B5"));
    settled.say("gogui-play_sequence b pass");
    EXPECT_EQ(settled.ask("genmove w"), "pass");
    EXPECT_EQ(settled.ask("final_score"), "W+0.5");
}

TEST(GtpEndgame, ResignsAfterHopelessMoves) {
    GtpGuest guest(small_game(9, 1100));
    guest.say("kata-set-param early-end false");
    guest.say("komi 300");
    std::string answer;
    int moves = 0;
    for (; moves < 12 && answer != "resign"; ++moves) {
        answer = guest.ask("genmove b");
        guest.say("play w pass");
    }
    // Not in the first moves of a game, and in the third hopeless one after them.
    EXPECT_EQ(moves, 8);
    EXPECT_EQ(answer, "resign");
}

TEST(GtpEndgame, AResignationIsTheResultUntilPlayGoesOn) {
    GtpGuest guest(small_game(9, 1100));
    guest.say("kata-set-param early-end false");
    guest.say("komi 300");
    while (guest.ask("genmove b") != "resign") guest.say("play w pass");
    EXPECT_EQ(guest.ask("final_score"), "W+R");
    EXPECT_EQ(result_in_sgf(guest), "W+R");
    guest.say("play b a1");
    EXPECT_EQ(result_in_sgf(guest), "");
}

TEST(GtpEndgame, NeverResignsWhenToldNotTo) {
    auto settings = small_game(9, 1100);
    settings.resign_below = 0;
    GtpGuest guest(settings);
    guest.say("komi 300");
    for (int i = 0; i < 5; ++i) EXPECT_NE(guest.ask("genmove b"), "resign");
}

TEST(GtpEndgame, AGamePlayedOutEndsInAgreement) {
    GtpGuest guest(small_game(5, 150));
    guest.say("komi 0.5");
    int passes = 0, moves = 0;
    for (; passes < 2 && moves < 200; ++moves)
        passes = guest.ask(moves % 2 == 0 ? "genmove b" : "genmove w") == "pass" ? passes + 1 : 0;
    EXPECT_EQ(passes, 2);
    EXPECT_LT(moves, 100);
    const auto score = guest.ask("final_score");
    EXPECT_EQ(guest.ask("final_score"), score);
    EXPECT_EQ(result_in_sgf(guest), score);
}

TEST(GtpClockTest, OvertimeWaitsBehindTheMainTime) {
    GtpClock clock;
    search::TimeControl control;
    control.unlimited = false;
    control.main = search::Milliseconds(60000);
    control.period = search::Milliseconds(10000);
    control.periods = 3;
    clock.set(control);
    clock.set_left(engine::Player::first, 20, 0);
    const auto& left = clock.left(engine::Player::first);
    EXPECT_EQ(left.main, search::Milliseconds(20000));
    EXPECT_EQ(left.periods, 3);
    // Japanese byo-yomi: the number counts periods.
    clock.set_left(engine::Player::first, 7, 2);
    EXPECT_EQ(left.main, search::Milliseconds(0));
    EXPECT_EQ(left.period, search::Milliseconds(7000));
    EXPECT_EQ(left.periods, 2);
    EXPECT_EQ(left.moves, 1);
    // The other side's clock is its own.
    EXPECT_EQ(clock.left(engine::Player::second).main, search::Milliseconds(60000));
}

TEST(GtpClockTest, CanadianOvertimeCountsStones) {
    GtpClock clock;
    search::TimeControl control;
    control.unlimited = false;
    control.period = search::Milliseconds(300000);
    control.periods = 1;
    control.period_moves = 25;
    clock.set(control);
    clock.set_left(engine::Player::second, 90, 8);
    const auto& left = clock.left(engine::Player::second);
    EXPECT_EQ(left.period, search::Milliseconds(90000));
    EXPECT_EQ(left.periods, 1);
    EXPECT_EQ(left.moves, 8);
    EXPECT_EQ(left.control.period_moves, 25);
    clock.spend(engine::Player::second, search::Milliseconds(10000));
    EXPECT_EQ(left.period, search::Milliseconds(80000));
    EXPECT_EQ(left.moves, 7);
}

TEST(GtpClockTest, AMoveStaysWithinTheTimeThatIsLeft) {
    auto settings = small_game(9, 0);
    GtpGuest guest(settings);
    for (const auto* time :
         {"time_settings 1 0 0", "kata-time_settings byoyomi 0 0.3 3",
          "kata-time_settings canadian 0 1 5", "kata-time_settings fischer 0.3 0.2"}) {
        ASSERT_EQ(guest.say(time), "=");
        const auto start = std::chrono::steady_clock::now();
        EXPECT_TRUE(guest.say("reg_genmove b").starts_with("= ")) << time;
        EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1)) << time;
    }
}

}  // namespace protocols
