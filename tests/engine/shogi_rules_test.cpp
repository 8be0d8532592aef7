// The rules of shogi case by case: drops, promotion, repetition, declaration, the ends of a game.
#include <gtest/gtest.h>

#include "engine/shogi/shogi.h"

namespace shogi {
namespace {

bool legal(std::string_view sfen, std::string_view move) {
    return Shogi::from_text(sfen).move_from_text(move).has_value();
}

void play(Shogi& game, std::initializer_list<const char*> moves) {
    for (const char* text : moves) {
        const auto move = game.move_from_text(text);
        ASSERT_TRUE(move) << text << " in " << game.to_text();
        game.play(*move);
    }
}

TEST(ShogiRules, TwoPawnsOnAFile) {
    constexpr auto sfen = "4k4/9/9/9/9/9/P8/+P8/4K4 b P 1";
    EXPECT_FALSE(legal(sfen, "P*9e"));
    EXPECT_TRUE(legal(sfen, "P*8e"));  // a promoted pawn does not count
    EXPECT_TRUE(legal("4k4/9/9/9/9/9/p8/+P8/4K4 b P 1", "P*9e"));
}

TEST(ShogiRules, PromotionByChoiceAndByForce) {
    constexpr auto sfen = "9/3P5/2P4N1/L3SG3/9/9/9/9/4K3k b - 1";
    for (const char* move : {"7c7b", "7c7b+", "6b6a+", "5d5c", "5d5c+", "9d9c", "9d9b+"})
        EXPECT_TRUE(legal(sfen, move)) << move;
    EXPECT_FALSE(legal(sfen, "6b6a"));  // a pawn without a further move
    EXPECT_FALSE(legal(sfen, "2c1a"));  // a knight likewise
    EXPECT_TRUE(legal(sfen, "2c1a+"));
    EXPECT_FALSE(legal(sfen, "4d4c+"));  // a gold
    // Leaving the camp promotes too.
    EXPECT_TRUE(legal("k8/9/6S2/9/9/9/9/9/4K4 b - 1", "3c2d+"));
    EXPECT_FALSE(legal("k8/9/9/6S2/9/9/9/9/4K4 b - 1", "3d2e+"));
}

TEST(ShogiRules, DropsNeedRoomToMove) {
    constexpr auto sfen = "4k4/9/9/9/9/9/9/9/4K4 b NLP 1";
    EXPECT_FALSE(legal(sfen, "P*1a"));
    EXPECT_FALSE(legal(sfen, "L*1a"));
    EXPECT_FALSE(legal(sfen, "N*1b"));
    EXPECT_TRUE(legal(sfen, "N*1c"));
    EXPECT_TRUE(legal(sfen, "L*1b"));
    EXPECT_FALSE(legal("4k4/9/9/9/9/9/9/9/4K4 w p 1", "P*1i"));
}

TEST(ShogiRules, DropPawnMate) {
    // The king in the corner, guarded by a gold: a pawn dropped before it mates.
    constexpr auto mates = "8k/6G2/7S1/9/9/9/9/9/4K4 b P 1";
    EXPECT_FALSE(legal(mates, "P*1b"));
    EXPECT_TRUE(legal(mates, "P*5b"));
    // With a way out, a check like any other.
    EXPECT_TRUE(legal("8k/9/7S1/9/9/9/9/9/4K4 b P 1", "P*1b"));
    // A pawn pushed may mate.
    EXPECT_TRUE(legal("8k/6G2/7SP/9/9/9/9/9/4K4 b - 1", "1c1b"));
    // The guard of the square is pinned, so it cannot take the pawn.
    EXPECT_FALSE(legal("R5g1k/6G2/7S1/9/9/9/9/9/4K4 b P 1", "P*1b"));
    // Free to take it.
    EXPECT_TRUE(legal("7gk/6G2/7S1/9/9/9/9/9/4K4 b P 1", "P*1b"));
}

TEST(ShogiRules, NoMoveIsALoss) {
    EXPECT_EQ(Shogi::from_text("4k4/4G4/4P4/9/9/9/9/9/4K4 w - 1").outcome(), Outcome::first_wins);
    // Not in check, yet unable to move.
    const auto stuck = Shogi::from_text("k8/2R6/1R7/9/9/9/9/9/4K4 w - 1");
    EXPECT_FALSE(stuck.in_check());
    EXPECT_EQ(stuck.outcome(), Outcome::first_wins);
}

TEST(ShogiRules, FourthOccurrenceDraws) {
    Shogi game;
    for (int round = 0; round < 3; ++round) {
        EXPECT_EQ(game.outcome(), Outcome::ongoing);
        EXPECT_EQ(game.repetitions(), round);
        play(game, {"2h3h", "8b7b", "3h2h", "7b8b"});
    }
    EXPECT_EQ(game.repetitions(), 3);
    EXPECT_EQ(game.outcome(), Outcome::draw);
    // A record may go on.
    play(game, {"7g7f"});
    EXPECT_EQ(game.outcome(), Outcome::ongoing);
}

// Same board, other hands: no repetition.
TEST(ShogiRules, HandsBelongToThePosition) {
    auto game = Shogi::from_text("4k4/9/9/9/9/9/9/9/4K4 b 2P 1");
    play(game, {"P*5e", "5a4a", "5e5d", "4a5a", "5d5c+", "5a4a", "5c5b", "4a5b"});
    EXPECT_EQ(game.repetitions(), 0);
    EXPECT_EQ(game.position().hand(Player::second, Kind::pawn), 1);
}

TEST(ShogiRules, PerpetualCheckLoses) {
    auto game = Shogi::from_text("4k4/9/9/9/9/9/9/4R4/K8 w - 1");
    // White runs to and fro, every move of Black checks.
    for (int round = 0; round < 3; ++round) {
        EXPECT_EQ(game.outcome(), Outcome::ongoing);
        play(game, {"5a4a", "5h4h", "4a5a", "4h5h"});
    }
    EXPECT_EQ(game.outcome(), Outcome::second_wins);

    // The same with one quiet move in between is a draw.
    auto quiet = Shogi::from_text("4k4/9/9/9/9/9/9/4R4/K8 w - 1");
    for (int round = 0; round < 3; ++round) play(quiet, {"5a4a", "5h3h", "4a5a", "3h5h"});
    EXPECT_EQ(quiet.outcome(), Outcome::draw);
}

TEST(ShogiRules, PerpetualCheckByWhite) {
    auto game = Shogi::from_text("k8/4r4/9/9/9/9/9/9/4K4 b - 1");
    for (int round = 0; round < 3; ++round) play(game, {"5i4i", "5b4b", "4i5i", "4b5b"});
    EXPECT_EQ(game.outcome(), Outcome::first_wins);
}

Outcome outcome_under(DeclarationRule rule, std::string_view sfen) {
    auto game = Shogi::from_text(sfen);
    game.set_declaration_rule(rule);
    EXPECT_EQ(game.can_declare_win(), game.outcome() == engine::win_for(game.to_play())) << sfen;
    return game.outcome();
}

// King, 9 small pieces and a dragon in the camp (14 points), a rook, a bishop and pawns in hand.
TEST(ShogiRules, DeclarationByPoints) {
    using enum DeclarationRule;
    constexpr auto with_27 = "KGGSS4/LLPP+R4/N8/9/9/9/9/9/8k b RB3P 1",
                   with_28 = "KGGSS4/LLPP+R4/N8/9/9/9/9/9/8k b RB4P 1",
                   with_30 = "KGGSS4/LLPP+R4/N8/9/9/9/9/9/8k b RB6P 1",
                   with_31 = "KGGSS4/LLPP+R4/N8/9/9/9/9/9/8k b RB7P 1";
    EXPECT_EQ(outcome_under(csa_rule_27, with_27), Outcome::ongoing);
    EXPECT_EQ(outcome_under(csa_rule_27, with_28), Outcome::first_wins);
    EXPECT_EQ(outcome_under(no_entering_king, with_31), Outcome::ongoing);
    EXPECT_EQ(outcome_under(csa_rule_24, with_30), Outcome::ongoing);
    EXPECT_EQ(outcome_under(csa_rule_24, with_31), Outcome::first_wins);
}

TEST(ShogiRules, WhiteNeedsOnePointLess) {
    using enum DeclarationRule;
    constexpr auto with_26 = "K8/9/9/9/9/9/8n/4+rppll/4ssggk w rb2p 1",
                   with_27 = "K8/9/9/9/9/9/8n/4+rppll/4ssggk w rb3p 1";
    EXPECT_EQ(outcome_under(csa_rule_27, with_26), Outcome::ongoing);
    EXPECT_EQ(outcome_under(csa_rule_27, with_27), Outcome::second_wins);
    EXPECT_EQ(outcome_under(csa_rule_24, with_27), Outcome::ongoing);
}

TEST(ShogiRules, DeclarationNeedsTenPiecesTheKingInsideAndNoCheck) {
    using enum DeclarationRule;
    constexpr auto nine = "KGGSS4/LLPP+R4/9/9/9/9/9/9/8k b RB9P 1",
                   outside = "1GGSS4/LLPP+R4/N8/K8/9/9/9/9/8k b RB6P 1",
                   checked = "KGGSS4/1LPP+R4/1LN6/r8/9/9/9/9/8k b B9P 1",
                   not_checked = "KGGSS4/1LPP+R4/1LN6/1r7/9/9/9/9/8k b B9P 1";
    EXPECT_EQ(outcome_under(csa_rule_27, nine), Outcome::ongoing);
    EXPECT_EQ(outcome_under(csa_rule_27, outside), Outcome::ongoing);
    EXPECT_EQ(outcome_under(csa_rule_27, checked), Outcome::ongoing);
    EXPECT_EQ(outcome_under(csa_rule_27, not_checked), Outcome::first_wins);
}

// White gave a rook: under the rules with H its 5 points count as if White had them.
TEST(ShogiRules, DeclarationInHandicapGames) {
    using enum DeclarationRule;
    constexpr auto with_21 = "K8/9/9/9/9/9/8n/4bppll/4ssggk w R2G2S3N2L14Pb2p 1",
                   with_22 = "K8/9/9/9/9/9/8n/4bppll/4ssggk w R2G2S3N2L13Pb3p 1";
    EXPECT_EQ(outcome_under(csa_rule_27, with_22), Outcome::ongoing);
    EXPECT_EQ(outcome_under(csa_rule_27_h, with_22), Outcome::second_wins);
    EXPECT_EQ(outcome_under(csa_rule_27_h, with_21), Outcome::ongoing);
    EXPECT_EQ(outcome_under(csa_rule_24_h, with_22), Outcome::ongoing);
}

TEST(ShogiRules, TryRule) {
    auto game = Shogi::from_text("9/3K5/9/9/9/9/9/9/8k b - 1");
    game.set_declaration_rule(DeclarationRule::try_rule);
    EXPECT_FALSE(game.can_declare_win());
    play(game, {"6b5a"});
    EXPECT_EQ(game.outcome(), Outcome::first_wins);
    game.set_declaration_rule(DeclarationRule::csa_rule_27);
    EXPECT_EQ(game.outcome(), Outcome::ongoing);
}

TEST(ShogiRules, RuleNames) {
    EXPECT_EQ(declaration_rule_from_name("CSARule24H"), DeclarationRule::csa_rule_24_h);
    EXPECT_EQ(declaration_rule_from_name("TryRule"), DeclarationRule::try_rule);
    EXPECT_FALSE(declaration_rule_from_name("csarule27"));
    EXPECT_EQ(Shogi().declaration_rule(), DeclarationRule::csa_rule_27);
}

TEST(ShogiRules, MoveLimitDraws) {
    Shogi game;
    game.set_move_limit(2);
    play(game, {"7g7f"});
    EXPECT_EQ(game.outcome(), Outcome::ongoing);
    play(game, {"3c3d"});
    EXPECT_EQ(game.outcome(), Outcome::draw);
    game.set_move_limit(0);
    EXPECT_EQ(game.outcome(), Outcome::ongoing);
    // A mate by the last move counts.
    auto mate = Shogi::from_text("4k4/9/4P4/9/9/9/9/9/4K4 b G 320");
    mate.set_move_limit(320);
    play(mate, {"G*5b"});
    EXPECT_EQ(mate.outcome(), Outcome::first_wins);
}

TEST(ShogiRules, MateProblemsMayLackTheAttackersKing) {
    auto game = Shogi::from_text("8k/9/7S1/9/9/9/9/9/9 b 2G 1");
    EXPECT_EQ(game.outcome(), Outcome::ongoing);
    EXPECT_EQ(checks(game.position()).size(), 7);
    play(game, {"G*1b"});
    EXPECT_EQ(game.outcome(), Outcome::first_wins);
}

TEST(ShogiRules, NearMatesAreSeen) {
    auto game = Shogi::from_text("8k/9/7S1/9/9/9/9/9/4K4 b 2G 1");
    auto mate = game.forced_mate();
    ASSERT_TRUE(mate);
    EXPECT_TRUE(mate->mates);
    EXPECT_EQ(mate->plies, 1);
    game.play(mate->move);
    EXPECT_EQ(game.outcome(), Outcome::first_wins);
    EXPECT_FALSE(Shogi().forced_mate());
    // The limit ends the game before the mate.
    game = Shogi::from_text("4k4/9/4P4/9/9/9/9/9/4K4 b G 321");
    game.set_move_limit(320);
    EXPECT_FALSE(game.forced_mate());
}

struct Refused {
    const char *sfen, *reason;
};

class ShogiSfen : public testing::TestWithParam<Refused> {};

TEST_P(ShogiSfen, RefusesWithTheReason) {
    try {
        Shogi::from_text(GetParam().sfen);
        FAIL() << "taken: " << GetParam().sfen;
    } catch (const engine::Error& error) {
        EXPECT_NE(std::string_view(error.what()).find(GetParam().reason), std::string_view::npos)
            << error.what();
    }
}

INSTANTIATE_TEST_SUITE_P(
    Bad, ShogiSfen,
    testing::Values(
        Refused{"4k4/9/9/9/9/9/9/9/4KK3 b - 1", "Black has two kings"},
        Refused{"4k4/4k4/9/9/9/9/9/9/4K4 b - 1", "White has two kings"},
        Refused{"9/9/9/9/9/9/9/9/9 b - 1", "no king"},
        Refused{"P3k4/9/9/9/9/9/9/9/4K4 b - 1", "Black has a pawn on the last rank"},
        Refused{"4k4/9/9/9/9/9/9/9/l3K4 b - 1", "White has a lance on the last rank"},
        Refused{"4k4/N8/9/9/9/9/9/9/4K4 b - 1", "Black has a knight on the last two ranks"},
        Refused{"4k4/9/9/P8/P8/9/9/9/4K4 b - 1", "Black has two pawns on file 9"},
        Refused{"4k4/9/9/9/9/9/9/4R4/4K4 b - 1", "White is in check, but it is the other's turn"},
        Refused{"4k4/9/9/9/9/9/9/9/4K4 b 19P 1", "no such number"},
        Refused{"4k4/9/9/9/9/9/9/9/4K4 b 10P9p 1", "19 pieces P, a set has 18"},
        Refused{"4k4/9/9/9/9/9/9/9/4K4 b 2R+r 1", "'+' is no piece in hand"},
        Refused{"+r+R2k4/9/9/9/9/9/9/9/4K4 w R 1", "3 pieces R, a set has 2"},
        Refused{"4k4/9/9/9/9/9/9/9/4K4 b K 1", "bad hands"},
        Refused{"4k4/9/9/9/9/9/9/9/4K4 b 2 1", "bad hands"},
        Refused{"4k4/9/9/9/9/9/9/9/4K4 b P2P 1", "twice in the hands"},
        Refused{"4k4/9/9/9/9/9/9/9/4K5 b - 1", "rank 9 is not 9 squares wide"},
        Refused{"4k3/9/9/9/9/9/9/9/4K4 b - 1", "rank 1 is not 9 squares wide"},
        Refused{"4k4/9/9/9/9/9/9/4K4 b - 1", "8 ranks"},
        Refused{"4+k4/9/9/9/9/9/9/9/4K4 b - 1", "does not promote"},
        Refused{"4k3+/9/9/9/9/9/9/9/4K4 b - 1", "not 9 squares wide"},
        Refused{"4k4/9/9/4x4/9/9/9/9/4K4 b - 1", "'x' is no piece (rank 4)"},
        Refused{"4k4/9/9/9/9/9/9/9/4K4 x - 1", "the mover is b or w"},
        Refused{"4k4/9/9/9/9/9/9/9/4K4 b - one", "no move number"},
        Refused{"4k4/9/9/9/9/9/9/9/4K4 b - 1 1", "are wanted"}, Refused{"", "are wanted"}));

TEST(ShogiSfen, RefusesOverlongLines) {
    EXPECT_THROW(Shogi::from_text(std::string(100000, '1')), engine::Error);
    EXPECT_THROW(Shogi::from_text("startpos" + std::string(1000, ' ')), engine::Error);
}

TEST(ShogiSfen, RoundTrip) {
    for (const char* sfen :
         {"lnsgkgsnl/1r5b1/ppppppppp/9/9/9/PPPPPPPPP/1B5R1/LNSGKGSNL b - 1",
          "8l/1l+R2P3/p2pBG1pp/kps1p4/Nn1P2G2/P1P1P2PP/1PS6/1KSG3+r1/LN2+p3L w Sbgn3p 124",
          "l6nl/5+P1gk/2np1S3/p1p4Pp/3P2Sp1/1PPb2P1P/P5GS1/R8/LN4bKL w RGgsn5p 1"})
        EXPECT_EQ(Shogi::from_text(sfen).to_text(), sfen);
    EXPECT_EQ(Shogi::from_text("startpos"), Shogi());
}

}  // namespace
}  // namespace shogi
