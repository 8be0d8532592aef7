// Readings of the end of a game: positions whose fate is known.
#include "protocols/go_judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/protocols/gtp_guest.h"

namespace protocols {

namespace {

using engine::Player;
using go::Go;
using go::Status;

Go board(std::string_view rows, const std::string& rules = "chinese") {
    auto game = Go::from_text(rows);
    game.set_rules(go::rules_from_text(rules));
    return game;
}

// Black's five and White's nine stones on the upper side share two liberties; what is around them
// lives.
constexpr std::string_view seki =
    "OOO1XXXO1/XXO1XOOOO/1XOXXO3/1XXOOO3/2XXO4/3XO4/3XO4/3XO4/3XO4 b - 0:0 7.5";

std::string names(std::vector<go::Point> points) {
    std::vector<std::string> all;
    for (const auto point : points) all.push_back(go::vertex(point));
    std::sort(all.begin(), all.end());
    std::string text;
    for (const auto& name : all) text.append(text.empty() ? "" : " ").append(name);
    return text;
}

// Both sides alive and apart, except that `doubted` belongs to Black by so much when Black or White
// moves first.
Looks looks_at(const Go& game, const std::vector<std::string>& doubted, float black, float white) {
    Looks looks;
    for (auto& look : looks) {
        const auto owners = go::score(game).owners;
        for (const auto& owner : owners)
            look.owners.push_back(!owner ? 0.0f : *owner == Player::first ? 0.9f : -0.9f);
    }
    for (const auto& name : doubted) {
        const auto point = *go::point_from_vertex(name, game.size());
        const auto at = static_cast<std::size_t>(point.y * game.size() + point.x);
        looks[0].owners[at] = black;
        looks[1].owners[at] = white;
    }
    looks[0].value = looks[1].value = game.to_play() == Player::first ? 0.9f : -0.9f;
    return looks;
}

// Says of every position that Black's value is such, and of moves that they are alike.
class Opinion final : public search::EvaluatorSource<Go> {
   public:
    explicit Opinion(float black) : black_(black) {}
    std::unique_ptr<search::Evaluator<Go>> make_evaluator() const override {
        return std::make_unique<Voice>(black_);
    }
    std::string_view name() const override { return "opinion"; }
    void check(const Go&) const override {}
    int policy_index(const Go&, go::Move move) const override { return move.code; }

   private:
    class Voice final : public search::Evaluator<Go> {
       public:
        explicit Voice(float black) : black_(black) {}
        void evaluate(std::span<const search::Query<Go>> queries) override {
            for (const auto& [game, moves, symmetry, answer] : queries) {
                const float value = game->to_play() == Player::first ? black_ : -black_;
                const auto count = static_cast<std::size_t>(moves->size());
                answer->priors.assign(count, 1 / static_cast<float>(count));
                answer->win = (1 + value) / 2;
                answer->loss = (1 - value) / 2;
            }
        }
        int symmetries(const Go&) const override { return 1; }
        std::uint64_t key(const Go& game) const override { return game.key(); }

       private:
        float black_;
    };
    float black_;
};

bool borne_out(const Go& game, float black) {
    const Reading reading(game, looks_at(game, {}, 0, 0));
    search::Searcher<Go> searcher(one_thread());
    searcher.set_position(game);
    searcher.set_network(std::make_shared<Opinion>(black));
    return bears_out(searcher, game, reading, {true, {}});
}

std::vector<std::string> words(const std::string& text) {
    std::istringstream in(text);
    return {std::istream_iterator<std::string>(in), {}};
}

}  // namespace

// 15 points for Black, 10 for White, and nothing left to play.
TEST(GoJudge, ANetworkMustAgreeWhoWins) {
    for (const char* rules : {"tromp-taylor", "chinese", "japanese"}) {
        const auto wins = board("2XO1/2XO1/2XO1/2XO1/2XO1 b - 0:0 0.5", rules);
        EXPECT_TRUE(borne_out(wins, 0.9f)) << rules;
        EXPECT_FALSE(borne_out(wins, -0.5f)) << rules;
        const auto loses = board("2XO1/2XO1/2XO1/2XO1/2XO1 b - 0:0 7.5", rules);
        EXPECT_TRUE(borne_out(loses, -0.9f)) << rules;
        EXPECT_FALSE(borne_out(loses, 0.5f)) << rules;
    }
}

TEST(GoJudge, SeesASeki) {
    for (const auto& [rules, score] :
         {std::pair{"chinese", "W+20.5"}, {"tromp-taylor", "W+20.5"}, {"japanese", "W+18.5"}}) {
        const auto game = board(seki, rules);
        GoJudge judge(one_thread());
        const auto reading = judge.read(game);
        EXPECT_EQ(names(reading.stones(Status::seki)), "A9 B9 C7 C8 C9 D7 E7 E8 E9 F9 G9");
        EXPECT_EQ(names(reading.dead()), "");
        EXPECT_EQ(reading.score().text(), score) << rules;
        EXPECT_TRUE(reading.settled());
        // Neither side puts itself into atari for the sake of a neutral point.
        EXPECT_TRUE(ending(game, reading, false).pass);
    }
}

// Games of GNU Go against itself (3.8, level 1, komi 6.5, Japanese rules), with the dead stones and
// the score it then said, which a look at the boards confirms.
TEST(GoJudge, AgreesWithGnuGoOnFinishedGames) {
    struct Game {
        std::string moves, dead, score;
    };
    const Game games[] = {
        {"E5 C3 G6 D6 E6 D7 D5 C5 E3 G3 H3 H4 H2 G5 G2 F6 F7 D4 F5 E8 F8 F9 G9 E9 G8 D2 E2 D1 E7 "
         "D8 D3 E4 F4 C4 E1 C2",
         "G3 G5 H4", "W+1.5"},
        {"E5 C3 E3 G3 G5 E2 F2 F3 D2 C5 H4 G7 E7 C7 F8 C2 D8 C8 E4 D9 E9 C9 C1 B1 D1 B2 D6 C6 D3 "
         "D7 C4 B4 D5 E8 F7 F9 G8 G9 H9 E9 H8 D4 pass C4",
         "E2 F3 G3 G7", "B+7.5"},
        {"G5 C4 E6 C7 E4 D3 E3 E8 E2 G7 B1 H6 H5 J5 J4 J6 H3 C2 C1 B2 D1 D5 G6 H7 F7 F8 A2 A3 E7 "
         "E5 F5 D7 D4 D6 F6 A1 D2 C3 A2 H4 G4 A1 G8 H8 A2 J3 J2 A1 pass A2",
         "G8", "W+20.5"},
    };
    for (const auto& [moves, dead, score] : games) {
        GtpGuest guest(small_game(9, 300));
        guest.say("kata-set-rules japanese");
        guest.say("komi 6.5");
        bool black = true;
        for (const auto& move : words(moves)) {
            ASSERT_EQ(guest.say((black ? "play b " : "play w ") + move), "=") << move;
            black = !black;
        }
        EXPECT_EQ(guest.ask("genmove b"), "pass");
        EXPECT_EQ(guest.ask("genmove w"), "pass");
        auto listed = words(guest.ask("final_status_list dead"));
        std::sort(listed.begin(), listed.end());
        EXPECT_EQ(listed, words(dead));
        EXPECT_EQ(guest.ask("final_score"), score);
        EXPECT_NE(guest.ask("printsgf").find("RE[" + score + "]"), std::string::npos);
    }
}

TEST(GoJudge, RemembersThePositionWhoeverIsToMove) {
    auto game = board(seki);
    GoJudge judge(one_thread());
    EXPECT_TRUE(judge.looks_over(game));
    const auto before = judge.read(game).winrate_moving(Player::first);
    game.play(Go::pass);
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(judge.read(game).winrate_moving(Player::first), before);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(10));
    EXPECT_FALSE(judge.hasty());
}

TEST(GoJudge, AnOpenBoardIsNotOver) {
    GoJudge judge(one_thread());
    Go game(9);
    for (const char* move : {"E5", "C3", "G6", "D6"}) game.play(*game.move_from_text(move));
    EXPECT_FALSE(judge.read(game).settled());
    EXPECT_TRUE(judge.read(game).dead().empty());
}

TEST(GoEnding, AnOpenBoardIsTooEarlyForAPass) {
    EXPECT_TRUE(too_early_to_pass(Go(19)));
    EXPECT_FALSE(too_early_to_pass(Go(3)));
    EXPECT_TRUE(is_emptier(board("2X1O2/7/7/7/7/7/7 b - 0:0 7.5"), 0.95));
    EXPECT_FALSE(is_emptier(board("2X1O2/7/7/7/7/7/7 b - 0:0 7.5"), 0.96));
    EXPECT_FALSE(too_early_to_pass(board("2XO1/2XO1/2XO1/2XO1/2XO1 b - 0:0 0.5")));
}

// Two walls with six neutral points between them: Black has 22 points, White 21.
constexpr std::string_view walls = "2X1O2/2X1O2/2X1O2/2XXO2/2X1O2/2X1O2/2X1O2 b - 0:0 ";
const std::vector<std::string> white_wall{"E1", "E2", "E3", "E4", "E5", "E6", "E7"};

Go walls_with(const std::string& komi, const std::string& rules = "chinese") {
    return board(std::string(walls) + komi, rules);
}

TEST(GoEnding, WhatIsAtStakeIsPlayedAndTheRestPassedOver) {
    const auto plan = [](const Go& game) {
        return ending(game, Reading(game, looks_at(game, {}, 0, 0)), false);
    };
    EXPECT_TRUE(plan(walls_with("-6.5")).pass);
    for (const char* komi : {"0.5", "5.5"}) {
        const auto close = plan(walls_with(komi));
        EXPECT_FALSE(close.pass);
        EXPECT_EQ(close.only.size(), 6U);
        for (const auto move : close.only) EXPECT_EQ(walls_with(komi).point_of(move)->x, 3);
    }
    // Territory beside an open neutral point would not count.
    EXPECT_EQ(plan(walls_with("-6.5", "japanese")).only.size(), 6U);
}

TEST(GoEnding, ALostGameIsPassedOnlyWhereTheSearchKnowsIt) {
    const auto game = walls_with("7.5");
    auto looks = looks_at(game, {}, 0, 0);
    EXPECT_FALSE(ending(game, Reading(game, looks), false).pass);
    looks[0].value = -0.9f;
    EXPECT_TRUE(ending(game, Reading(game, looks), false).pass);
}

TEST(GoEnding, AFateThatHangsOnTheMoveIsNotSettled) {
    const auto game = walls_with("6.5");
    EXPECT_TRUE(Reading(game, looks_at(game, white_wall, -0.9f, -0.9f)).settled());
    const Reading open(game, looks_at(game, white_wall, 0.8f, -0.9f));
    EXPECT_FALSE(open.settled());
    EXPECT_FALSE(ending(game, open, false).pass);
}

TEST(GoEnding, DeadStonesComeOffWhereTheRulesAgreeOnThem) {
    const auto game = walls_with("6.5");
    const Reading reading(game, looks_at(game, white_wall, 0.8f, 0.9f));
    EXPECT_EQ(names(reading.dead()), "E1 E2 E3 E4 E5 E6 E7");
    EXPECT_EQ(names(reading.stones(Status::dead)), names(reading.dead()));
    EXPECT_EQ(reading.score().text(), "B+42.5");
}

TEST(GoEnding, RulesWithoutAgreementKnowNoDeadStones) {
    const auto game = walls_with("6.5", "tromp-taylor");
    auto looks = looks_at(game, white_wall, 0.8f, 0.9f);
    for (auto& look : looks)
        for (float& owner : look.owners) owner = 0.9f;
    const Reading reading(game, looks);
    EXPECT_TRUE(reading.dead().empty());
    EXPECT_TRUE(reading.stones(Status::dead).empty());
    EXPECT_EQ(reading.score().text(), "W+5.5");
    EXPECT_TRUE(reading.settled());
    // They are captured instead, and so they are wherever a clean-up is asked for.
    const auto plan = ending(game, reading, false);
    EXPECT_FALSE(plan.pass);
    EXPECT_EQ(plan.only.size(), 13U);
    const auto chinese = walls_with("6.5");
    EXPECT_TRUE(ending(chinese, Reading(chinese, looks), false).pass);
    EXPECT_EQ(ending(chinese, Reading(chinese, looks), true).only.size(), 13U);
}

}  // namespace protocols
